#include "tools/scene/keys/chosen_words.hpp"

#include <algorithm>

#include "tools/scene/json/keys.hpp"

namespace tamp::tools
{

namespace
{

class WordFinder
{
 public:
  /// Looks at all words in an object that has these keys.
  void look_at(const Json& object, const ObjectKeys& keys, const JsonPointer& pointer)
  {
    look_at(object, keys.keys, pointer);
    for (const TypeKeys& type : keys.types) {
      if (object.contains("type") && object["type"] == type.word) look_at(object, type.keys, pointer);
    }
  }

  Json found = Json::array();

 private:
  void look_at(const Json& object, const std::vector<Key>& keys, const JsonPointer& pointer)
  {
    for (const Key& key : keys) {
      const auto value = object.find(key.name);
      if (value != object.end()) look_at_value(*value, key, pointer / key.name);
    }
  }

  void look_at_value(const Json& value, const Key& key, const JsonPointer& pointer)
  {
    const Value& kind = key.value;
    if (std::holds_alternative<Choice>(kind) && value.is_string()) {
      add(key, value.get<std::string>(), pointer);
    } else if (const auto* object = std::get_if<Object>(&kind); object != nullptr && value.is_object()) {
      look_at(value, object->keys(), pointer);
    } else if (const auto* members = std::get_if<Members>(&kind); members != nullptr && value.is_object()) {
      for (const auto& [name, member] : value.items()) look_at(member, members->keys(), pointer / name);
    } else if (const auto* objects = std::get_if<Objects>(&kind); objects != nullptr && value.is_array()) {
      for (std::size_t k = 0; k < value.size(); ++k) look_at(value[k], objects->keys(), pointer / k);
    }
  }

  void add(const Key& key, const std::string& word, const JsonPointer& pointer)
  {
    const auto& choice = std::get<Choice>(key.value);
    const auto place = static_cast<std::size_t>(std::ranges::find(choice.words, word) - choice.words.begin());
    const std::string meaning = place < choice.meanings.size() ? choice.meanings[place] : "";
    found.push_back(
        {{"key", pointer.to_string()}, {"word", word}, {"about", about(key, meaning)}, {"meaning", meaning}});
  }

  /// The meaning of a key before its list of words, or all of it where words have no meanings of their own.
  static std::string about(const Key& key, const std::string& meaning)
  {
    if (meaning.empty()) return key.meaning;
    const std::size_t words = key.meaning.find("`\"");
    return words == std::string::npos ? key.meaning : key.meaning.substr(0, words);
  }
};

}  // namespace

Json chosen_words(const Json& resolved)
{
  WordFinder finder;
  finder.look_at(resolved, scene_keys(), JsonPointer());
  return std::move(finder.found);
}

}  // namespace tamp::tools
