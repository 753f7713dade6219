#include "tools/scene/keys/schema.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <regex>

#include "tools/scene/json/keys.hpp"

namespace tamp::tools
{

namespace
{

/// A part of an object is laid over a whole one.
enum class Extent { whole, part };

constexpr const char* plain_name = "^[A-Za-z0-9_-]+$";

Json number_in(const Range& range)
{
  Json schema{{"type", "number"}};
  if (std::isfinite(range.lower)) schema[range.holds_lower ? "minimum" : "exclusiveMinimum"] = range.lower;
  if (std::isfinite(range.upper)) schema[range.holds_upper ? "maximum" : "exclusiveMaximum"] = range.upper;
  return schema;
}

Json whole_number_in(int least, int most)
{
  return {{"type", "integer"}, {"minimum", least}, {"maximum", most}};
}

Json list_of(const Json& item, Length length)
{
  return {{"type", "array"}, {"items", item}, {"minItems", length.in_plane}, {"maxItems", length.in_space}};
}

Json one_schema_of(const std::vector<Json>& schemas)
{
  return schemas.size() == 1 ? schemas.front() : Json{{"anyOf", schemas}};
}

Json or_null(Json schema)
{
  if (schema.contains("type")) {
    schema["type"] = {schema["type"], "null"};
  } else if (schema.contains("enum")) {
    schema["enum"].push_back(nullptr);
  } else if (schema.contains("anyOf")) {
    schema["anyOf"].push_back({{"type", "null"}});
  } else {
    schema = one_schema_of({schema, {{"type", "null"}}});
  }
  return schema;
}

/// The meaning of a key, for an editor to show. Its links lead from docs/reference/scene.md to pages beside it or, by
/// `../`, to those of other folders.
std::string description(const Key& key)
{
  static const std::regex to_other_folder(R"(\[[^\]]*\]\(\.\./([^)]*)\))"), link(R"(\[[^\]]*\]\(([^)]*)\))");
  std::string text = std::regex_replace(key.meaning, to_other_folder, "docs/$1");
  text = std::regex_replace(text, link, "docs/reference/$1");
  if (!key.unit.empty()) text += (text.empty() ? "[" : " [") + shown_unit(key.unit) + "]";
  const Default& left_out = key.default_value;
  if (left_out.compulsory || !left_out.value.is_null() || left_out.words.empty()) return text;
  return text + (text.empty() ? "default: " : "; default: ") + left_out.words;
}

class SchemaWriter
{
 public:
  Json written()
  {
    const Json scene = object(scene_keys(), Extent::whole);
    return {{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "A scene of TAMP"},
            {"allOf", {scene}},
            {"definitions", std::move(definitions_)}};
  }

 private:
  Json of(const Text&, Extent) { return {{"type", "string"}}; }
  Json of(const Flag&, Extent) { return {{"type", "boolean"}}; }
  Json of(const File&, Extent) { return {{"type", "string"}}; }
  Json of(const Name& name, Extent extent)
  {
    std::vector<Json> either{{{"type", "string"}, {"pattern", plain_name}}};
    for (const Instead& instead : name.instead) either.push_back(object(instead.keys(), extent));
    return one_schema_of(either);
  }
  Json of(const Names& names, Extent extent) { return list_of(of(Name{}, extent), names.length); }
  Json of(const SomeNames&, Extent)
  {
    return {{"type", "array"}, {"items", {{"type", "string"}}}, {"uniqueItems", true}};
  }
  Json of(const Anything&, Extent) { return Json::object(); }
  Json of(const Number& number, Extent)
  {
    std::vector<Json> either{number_in(number.range)};
    if (!number.word.empty()) either.push_back({{"enum", {number.word}}});
    return one_schema_of(either);
  }
  Json of(const Numbers& numbers, Extent) { return list_of(number_in(numbers.range), numbers.length); }
  Json of(const WholeNumber& number, Extent) { return whole_number_in(number.least, number.most); }
  Json of(const WholeNumbers& numbers, Extent)
  {
    return list_of(whole_number_in(numbers.least, numbers.most), numbers.length);
  }
  Json of(const Rows& rows, Extent)
  {
    return {{"type", "array"}, {"items", list_of(number_in(any_number), rows.length)}};
  }
  Json of(const Choice& choice, Extent extent)
  {
    std::vector<std::string> words = choice.words;
    for (const auto& [old, now] : choice.old_words) words.push_back(old);
    std::vector<Json> either{{{"enum", words}}};
    for (const Instead& instead : choice.instead) either.push_back(object(instead.keys(), extent));
    return one_schema_of(either);
  }
  Json of(const Object& value, Extent extent) { return object(value.keys(), extent); }
  Json of(const Members& members, Extent extent)
  {
    const Json member = object(members.keys(), extent);
    Json schema{{"type", "object"}, {"propertyNames", {{"pattern", plain_name}}}};
    if (extent == Extent::whole) schema["minProperties"] = 1;
    schema["additionalProperties"] = extent == Extent::whole ? member : or_null(member);
    return schema;
  }
  /// A list is not merged with another, but takes its place.
  Json of(const Objects& objects, Extent)
  {
    return {{"type", "array"}, {"items", object(objects.keys(), Extent::whole)}};
  }

  Json schema_of(const Key& key, Extent extent)
  {
    Json schema = std::visit([&](const auto& value) { return of(value, extent); }, key.value);
    if (extent == Extent::part || !key.default_value.compulsory) schema = or_null(std::move(schema));
    // Beside a reference nothing counts.
    if (schema.contains("$ref")) schema = {{"allOf", {schema}}};
    const std::string text = description(key);
    if (!text.empty()) schema["description"] = text;
    // How long a list is depends on the scene.
    const bool is_list = std::holds_alternative<Numbers>(key.value) || std::holds_alternative<WholeNumbers>(key.value);
    if (!key.default_value.value.is_null() && !is_list) schema["default"] = key.default_value.value;
    return schema;
  }

  /// Under the name that the key had, which an editor is not to fill in.
  Json schema_of_old(const Key& key, Extent extent)
  {
    Json schema = schema_of(key, extent);
    schema["description"] = "now " + key.name;
    schema.erase("default");
    return schema;
  }

  /// The keys of the lists; one that stands in several may be as in any of them.
  Json fields(const std::vector<const std::vector<Key>*>& lists, Extent extent)
  {
    std::vector<std::pair<std::string, std::vector<Json>>> properties;
    const auto add = [&](const std::string& name, const Json& schema) {
      auto at = std::find_if(properties.begin(), properties.end(), [&](const auto& p) { return p.first == name; });
      if (at == properties.end()) at = properties.insert(at, {name, {}});
      if (std::find(at->second.begin(), at->second.end(), schema) == at->second.end()) at->second.push_back(schema);
    };
    Json required = Json::array();
    for (const std::vector<Key>* list : lists) {
      for (const Key& key : *list) {
        add(key.name, schema_of(key, extent));
        if (!key.old_name.empty()) add(key.old_name, schema_of_old(key, extent));
        if (key.default_value.compulsory && key.only_in == 0) required.push_back(key.name);
      }
    }
    Json schema{{"type", "object"}, {"properties", Json::object()}};
    for (const auto& [name, schemas] : properties) schema["properties"][name] = one_schema_of(schemas);
    if (extent == Extent::whole && !required.empty()) schema["required"] = required;
    schema["additionalProperties"] = extent == Extent::whole ? Json(false) : Json{{"type", "null"}};
    return schema;
  }

  /// The keys of an object that its "type" decides on; of a part without it, the keys of all types.
  Json typed(const ObjectKeys& keys, const std::vector<Key>& common, Extent extent)
  {
    Json words = Json::array(), cases = Json::array();
    std::vector<const std::vector<Key>*> all{&common};
    for (const TypeKeys& type : keys.types) {
      words.push_back(type.word);
      all.push_back(&type.keys);
      Json then = fields({&common, &type.keys}, extent);
      then["properties"]["type"] = true;
      if (!type.meaning.empty()) then["description"] = type.meaning;
      cases.push_back({{"if", {{"properties", {{"type", {{"const", type.word}}}}}, {"required", {"type"}}}},
                       {"then", std::move(then)}});
    }
    Json schema{{"type", "object"}, {"properties", {{"type", {{"enum", words}}}}}};
    if (extent == Extent::whole) {
      schema["required"] = {"type"};
    } else {
      schema["if"] = {{"not", {{"required", {"type"}}}}};
      schema["then"] = fields(all, extent);
    }
    schema["allOf"] = std::move(cases);
    return schema;
  }

  Json object(const ObjectKeys& keys, Extent extent)
  {
    if (keys.name.empty()) return fields({&keys.keys}, extent);
    const std::string name = (extent == Extent::part ? "part_of_" : "") + keys.name;
    Json reference{{"$ref", "#/definitions/" + name}};
    if (definitions_.contains(name)) return reference;
    definitions_[name] = nullptr;  // it may refer to itself
    definitions_[name] = definition(keys, extent);
    return reference;
  }

  Json definition(const ObjectKeys& keys, Extent extent)
  {
    std::vector<Key> common = keys.keys;
    if (keys.may_be_a_file) common.push_back({"$schema", Text{}, "", {}, "for editors: where this schema is"});
    if (keys.may_be_a_file && extent == Extent::part) {
      common.push_back({"file", File{}, "", compulsory, "a JSON file, over whose object the other keys are merged"});
    }
    const auto all = [&] { return keys.types.empty() ? fields({&common}, extent) : typed(keys, common, extent); };
    if (!keys.may_be_a_file || extent == Extent::part) return all();
    return {{"if", {{"required", {"file"}}}}, {"then", object(keys, Extent::part)}, {"else", all()}};
  }

  Json definitions_ = Json::object();
};

}  // namespace

Json scene_schema()
{
  return SchemaWriter().written();
}

std::string shown_unit(std::string unit)
{
  for (const auto& [power, sign] : {std::pair{"^2", "²"}, std::pair{"^3", "³"}}) {
    const std::size_t at = unit.find(power);
    if (at != std::string::npos) unit.replace(at, 2, sign);
  }
  return unit;
}

}  // namespace tamp::tools
