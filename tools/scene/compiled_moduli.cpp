#include "tools/scene/compiled_moduli.hpp"

#include <fmt/core.h>

namespace tamp::tools
{

std::vector<std::string> compiled_moduli(const CheckedScene& checked)
{
  std::vector<std::string> lines;
  for (const tasks::SceneMaterial& material : checked.scene.materials) {
    const auto* const sand = std::get_if<components::TabularCap>(&material.model);
    if (sand == nullptr) continue;
    const auto* const surface = std::get_if<components::ModulusSurface>(&sand->parameters().modulus);
    if (surface == nullptr) continue;
    const Json& modulus = checked.resolved.at("materials").at(material.name).at("modulus");
    const components::SurfaceErrors& errors = surface->errors();
    lines.push_back(
        fmt::format("modulus of {}: {} compiled to {:.3g}: {} patches, largest "
                    "error p {:.2g}, K {:.2g}",
                    material.name, modulus.at("type").get<std::string>(), modulus.at("compile").get<double>(),
                    errors.n_patches, errors.pressure, errors.bulk_modulus));
  }
  return lines;
}

}  // namespace tamp::tools
