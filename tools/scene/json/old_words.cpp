#include "tools/scene/json/old_words.hpp"

#include <algorithm>

namespace tamp::tools
{

namespace
{

/// The key that has this name now or had it once; of an object with types, that of any type.
const Key* find_key(const ObjectKeys& keys, const std::string& name)
{
  const auto find = [&](const std::vector<Key>& list) -> const Key* {
    const auto at =
        std::find_if(list.begin(), list.end(), [&](const Key& k) { return k.name == name || k.old_name == name; });
    return at == list.end() ? nullptr : &*at;
  };
  const Key* found = find(keys.keys);
  for (const TypeKeys& type : keys.types) {
    if (found == nullptr) found = find(type.keys);
  }
  return found;
}

class Replacement
{
 public:
  void in_object(Json& object, const ObjectKeys& keys, const JsonPointer& place, const JsonPointer& place_now)
  {
    if (!object.is_object()) return;
    Json now = Json::object();
    for (auto& [name, value] : object.items()) {
      const Key* const key = find_key(keys, name);
      const std::string& name_now = key == nullptr ? name : key->name;
      if (name_now != name) {
        found.push_back({place / name, place_now / name_now, name, name_now, object.contains(name_now)});
      }
      if (key != nullptr) in_value(value, key->value, place / name, place_now / name_now);
      now[name_now] = std::move(value);
    }
    object = std::move(now);
  }

  std::vector<OldWord> found;

 private:
  void in_value(Json& value, const Value& kind, const JsonPointer& place, const JsonPointer& place_now)
  {
    if (const auto* choice = std::get_if<Choice>(&kind)) {
      in_choice(value, *choice, place, place_now);
    } else if (const auto* object = std::get_if<Object>(&kind)) {
      in_object(value, object->keys(), place, place_now);
    } else if (const auto* members = std::get_if<Members>(&kind); members != nullptr && value.is_object()) {
      for (auto& [name, member] : value.items()) in_object(member, members->keys(), place / name, place_now / name);
    } else if (const auto* objects = std::get_if<Objects>(&kind); objects != nullptr && value.is_array()) {
      for (std::size_t i = 0; i < value.size(); ++i) in_object(value[i], objects->keys(), place / i, place_now / i);
    }
  }

  void in_choice(Json& value, const Choice& choice, const JsonPointer& place, const JsonPointer& place_now)
  {
    for (const Instead& instead : choice.instead) in_object(value, instead.keys(), place, place_now);
    if (!value.is_string()) return;
    const auto at = choice.old_words.find(value.get<std::string>());
    if (at == choice.old_words.end()) return;
    found.push_back({place, place_now, at->first, at->second});
    value = at->second;
  }
};

}  // namespace

std::vector<OldWord> replace_old_words(Json& object, const ObjectKeys& keys)
{
  Replacement replacement;
  replacement.in_object(object, keys, JsonPointer(), JsonPointer());
  return std::move(replacement.found);
}

}  // namespace tamp::tools
