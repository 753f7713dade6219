#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "components/alternatives.hpp"
#include "components/parameter.hpp"
#include "tools/scene/json/json_reader.hpp"
#include "tools/scene/json/keys.hpp"

/// The keys of an object that says itself what it consists of: it lists them as `parameters()` (parameter.hpp).
namespace tamp::tools
{

template <class Owner>
Key key_of(const components::Parameter<Owner>& parameter)
{
  static const Owner usual{};
  const auto key = [&](Value value, const Json& left_out) -> Key {
    return {std::string(parameter.key), std::move(value), std::string(parameter.unit),
            parameter.optional ? Default{left_out} : compulsory, std::string(parameter.meaning)};
  };
  return std::visit(
      [&]<class T>(T Owner::*member) {
        if constexpr (std::is_same_v<T, double>) {
          Key number = key(Number{parameter.range}, usual.*member);
          if (parameter.optional && !std::isfinite(usual.*member)) number.default_value = none;
          return number;
        } else if constexpr (std::is_same_v<T, int>) {
          const Range& range = parameter.range;
          return key(WholeNumber{static_cast<int>(range.lower), static_cast<int>(range.upper)}, usual.*member);
        } else if constexpr (std::is_same_v<T, bool>) {
          return key(Flag{}, usual.*member);
        } else {
          return key(Numbers{per_axis, parameter.range}, (usual.*member)[0]);
        }
      },
      parameter.value);
}

template <class Owner>
std::vector<Key> keys_of_parameters()
{
  std::vector<Key> keys;
  for (const components::Parameter<Owner>& parameter : Owner::parameters()) keys.push_back(key_of(parameter));
  return keys;
}

/// The kinds of a list, as a key may have them: by their words, or those with parameters as an object of these.
struct KindKeys {
  std::vector<components::Word<int>> words{};  ///< the values are places in the list
  std::vector<Instead> objects{};
  std::string meanings{};
};

template <class Kind>
const ObjectKeys& parameters_of()
{
  static const ObjectKeys keys{"", keys_of_parameters<Kind>()};
  return keys;
}

/// Kinds that have neither are for the reader to tell.
template <class Kinds>
KindKeys keys_of_kinds()
{
  KindKeys keys;
  int place = 0;
  std::string of_objects;
  components::for_each_alternative<Kinds>([&]<class Kind>(std::type_identity<Kind>) {
    if constexpr (requires { Kind::shown; }) {
      of_objects += fmt::format("; `{}`: {}", Kind::shown, Kind::meaning);
      if constexpr (components::has_parameters<Kind>) {
        keys.objects.push_back({parameters_of<Kind>, std::string(Kind::shown), place});
      }
    } else {
      keys.words.push_back({Kind::word, place, Kind::meaning});
    }
    ++place;
  });
  keys.meanings = meanings_of(keys.words) + of_objects;
  return keys;
}

template <class Owner>
void read_parameter(const components::Parameter<Owner>& parameter, JsonReader& reader, Owner& owner)
{
  const std::string key(parameter.key);
  std::visit(
      [&]<class T>(T Owner::*member) {
        T& value = owner.*member;
        if constexpr (std::is_same_v<T, double>) {
          value = parameter.optional && !std::isfinite(value) ? reader.optional_number(key).value_or(value)
                                                              : reader.number(key);
        } else if constexpr (std::is_same_v<T, int>) {
          value = reader.whole_number(key);
        } else if constexpr (std::is_same_v<T, bool>) {
          value = reader.flag(key);
        } else {
          const std::vector<double> numbers = reader.numbers(key);
          value.setZero();
          std::copy(numbers.begin(), numbers.end(), value.begin());
        }
      },
      parameter.value);
}

/// Reads all of them into `owner`, which has the values of those that are left out.
template <class Owner>
void read_parameters(JsonReader& reader, Owner& owner)
{
  for (const components::Parameter<Owner>& parameter : Owner::parameters()) read_parameter(parameter, reader, owner);
}

/// The kind at a place of the list, with the parameters that stand at the key if it has any.
template <class Kinds>
Kinds read_kind(JsonReader& reader, const std::string& key, int place)
{
  return components::with_alternative<Kinds>(static_cast<std::size_t>(place),
                                             [&]<class Kind>(std::type_identity<Kind>) -> Kinds {
                                               Kind kind{};
                                               if constexpr (components::has_parameters<Kind>) {
                                                 JsonReader own = reader.object(key);
                                                 read_parameters(own, kind);
                                                 own.finish();
                                               }
                                               return kind;
                                             });
}

}  // namespace tamp::tools
