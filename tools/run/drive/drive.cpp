#include "tools/run/drive/drive.hpp"

#include "tools/run/drive/increments.hpp"
#include "tools/run/drive/mixed_segment.hpp"

namespace tamp::tools
{

namespace
{

/// Takes the point, which is at the path's first row, along it.
void follow(const Course& course, const DeformationPath& path, MaterialPoint& point)
{
  course.show(path.time(0, 0), point);
  for (std::size_t segment = 0; segment < path.n_segments(); ++segment) {
    const std::size_t n = n_increments(path, segment, course.largest_strain);
    for (std::size_t i = 1; i <= n; ++i) {
      const double fraction = static_cast<double>(i) / static_cast<double>(n), time = path.time(segment, fraction);
      const auto failure = deform(course.material.model, path.deformation_gradient(segment, fraction), point);
      if (failure) throw course.error(*failure, time, segment + 2);
      course.show(time, point);
    }
  }
}

void follow(const Course& course, const MixedPath& path, MaterialPoint& point)
{
  const auto& rows = path.rows();
  course.show(rows.front().time, point);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    follow(course, MixedSegment{path.controls(), rows[i - 1], rows[i], i + 1}, point);
  }
}

/// Fresh material, brought to the stress of a row at the deformation that the row prescribes.
MaterialPoint brought_to(const Course& course, const std::vector<StressControl>& controls, const MixedRow& row)
{
  const Matrix<3> start = completed(row.deformation_gradient, controls, Matrix<3>::Identity());
  MaterialPoint point = fresh_point(course.material.model, start);
  if (controls.empty()) return point;
  MixedRow fresh = row;
  for (std::size_t k = 0; k < controls.size(); ++k) fresh.stress[k] = controls[k].stress_of(point.stress);
  const ShowPoint show_nothing = [](double, const MaterialPoint&) {};
  const Course unseen{course.material, course.largest_strain, show_nothing, course.is_test};
  follow(unseen, MixedSegment{controls, fresh, row, 1}, point);
  return point;
}

}  // namespace

void drive(const tasks::SceneMaterial& material, const DeformationPath& path, double largest_strain,
           const ShowPoint& show)
{
  MaterialPoint point = fresh_point(material.model, path.deformation_gradient(0, 0));
  follow(Course{material, largest_strain, show}, path, point);
}

void drive(const tasks::SceneMaterial& material, const MixedPath& path, double largest_strain, const ShowPoint& show)
{
  const Course course{material, largest_strain, show};
  MaterialPoint point = brought_to(course, path.controls(), path.rows().front());
  follow(course, path, point);
}

void drive(const tasks::SceneMaterial& material, const LaboratoryTest& test, double largest_strain,
           const ShowPoint& show)
{
  const Course course{material, largest_strain, show, true};
  const auto [controls, stress] = stress_at_start(test);
  MaterialPoint point = brought_to(course, controls, {0, Matrix<3>::Identity(), stress});
  const LoadPath path = path_of(test, point.deformation_gradient);
  std::visit([&](const auto& any_path) { follow(course, any_path, point); }, path);
}

}  // namespace tamp::tools
