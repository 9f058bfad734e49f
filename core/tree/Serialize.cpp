// SPDX-License-Identifier: BSD-3-Clause
#include "core/tree/Serialize.h"

#include "core/base/Error.h"
#include "core/tree/NodeFactory.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace hybridtree
{
namespace
{

// Keeps the order of parameters as the nodes give them.
using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "HybridTree";
constexpr int kVersion = 1;

Json toJson(const Parameters& parameters)
{
  Json object = Json::object();
  for (const auto& [name, value] : parameters.entries())
  {
    std::visit([&, key = name](const auto& held) { object[key] = held; }, value);
  }
  return object;
}

class Writer
{
public:
  // Index of the node in the table; shared nodes are found again.
  std::size_t add(const Node& node)
  {
    const auto known = index_.find(&node);
    if (known != index_.end())
    {
      return known->second;
    }
    std::vector<std::size_t> children;
    for (const NodePtr& child : node.children())
    {
      children.push_back(this->add(*child));
    }
    Json entry = { { "kind", node.kind() }, { "parameters", toJson(node.parameters()) } };
    if (!children.empty())
    {
      entry["children"] = children;
    }
    table_.push_back(std::move(entry));
    return index_[&node] = table_.size() - 1;
  }

  Json takeTable() { return std::move(table_); }

private:
  std::unordered_map<const Node*, std::size_t> index_;
  Json table_ = Json::array();
};

// Lists hold either integers only, or numbers.
Parameters::Value listFrom(const Json& list)
{
  const auto isInteger = [](const Json& item)
  {
    return item.is_number_integer() &&
      !(item.is_number_unsigned() &&
        item.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX));
  };
  if (!std::all_of(list.begin(), list.end(), [](const Json& item) { return item.is_number(); }))
  {
    throw InvalidText("is a list of other things than numbers.");
  }
  if (!list.empty() && std::all_of(list.begin(), list.end(), isInteger))
  {
    return list.get<std::vector<std::int64_t>>();
  }
  return list.get<std::vector<double>>();
}

Parameters::Value valueFrom(const Json& json)
{
  switch (json.type())
  {
    case Json::value_t::boolean:
      return json.get<bool>();
    case Json::value_t::number_unsigned:
      if (json.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX))
      {
        return json.get<double>();
      }
      return json.get<std::int64_t>();
    case Json::value_t::number_integer:
      return json.get<std::int64_t>();
    case Json::value_t::number_float:
      return json.get<double>();
    case Json::value_t::string:
      return json.get<std::string>();
    case Json::value_t::array:
      return listFrom(json);
    default:
      throw InvalidText("is neither a number, a string, true, false nor a list of numbers.");
  }
}

Parameters parametersFrom(const Json& object)
{
  Parameters parameters;
  for (const auto& [name, value] : object.items())
  {
    try
    {
      parameters.set(name, valueFrom(value));
    }
    catch (const InvalidText& error)
    {
      throw InvalidText("Parameter \"" + name + "\" " + error.what());
    }
  }
  return parameters;
}

class Reader
{
public:
  explicit Reader(const MeshLookup& lookup) : lookup_(lookup) {}

  NodePtr read(const Json& table)
  {
    for (const Json& entry : table)
    {
      try
      {
        this->add(entry);
      }
      // Whatever a maker finds wrong is wrong with the text.
      catch (const Error& error)
      {
        throw InvalidText(
          "Node " + std::to_string(nodes_.size()) + " of the tree's text: " + error.what());
      }
    }
    return nodes_.back();
  }

private:
  void add(const Json& entry)
  {
    if (!entry.is_object() || !entry.contains("kind") || !entry["kind"].is_string())
    {
      throw InvalidText("It has no \"kind\".");
    }
    const std::string kind = entry["kind"].get<std::string>();
    Parameters parameters;
    if (entry.contains("parameters"))
    {
      if (!entry["parameters"].is_object())
      {
        throw InvalidText("Its \"parameters\" are not an object.");
      }
      parameters = parametersFrom(entry["parameters"]);
    }
    nodes_.push_back(makeNode(kind, parameters, this->childrenFrom(entry), lookup_));
  }

  std::vector<NodePtr> childrenFrom(const Json& entry) const
  {
    std::vector<NodePtr> children;
    if (!entry.contains("children"))
    {
      return children;
    }
    const Json& list = entry["children"];
    if (!list.is_array())
    {
      throw InvalidText("Its \"children\" are not a list.");
    }
    for (const Json& item : list)
    {
      if (!item.is_number_unsigned() || item.get<std::uint64_t>() >= nodes_.size())
      {
        throw InvalidText("Its child " + item.dump() + " is not the index of a node before it.");
      }
      children.push_back(nodes_[item.get<std::size_t>()]);
    }
    return children;
  }

  MeshLookup lookup_;
  std::vector<NodePtr> nodes_;
};

const Json& tableOf(const Json& document)
{
  if (!document.is_object() || !document.contains("format") || document["format"] != kFormat)
  {
    throw InvalidText("The text is not that of a HybridTree: \"format\" is not \"HybridTree\".");
  }
  if (!document.contains("version") || !document["version"].is_number_integer())
  {
    throw InvalidText("The text of the tree has no \"version\".");
  }
  if (document["version"] != kVersion)
  {
    throw InvalidText("The text of the tree is of version " + document["version"].dump() +
      "; this program reads version " + std::to_string(kVersion) + ".");
  }
  if (!document.contains("nodes") || !document["nodes"].is_array() || document["nodes"].empty())
  {
    throw InvalidText("The text of the tree has no \"nodes\".");
  }
  return document["nodes"];
}

void collectMeshes(const Node& node, std::unordered_set<const Node*>& seen,
  std::vector<std::pair<std::string, MeshPtr>>& meshes)
{
  if (!seen.insert(&node).second)
  {
    return;
  }
  if (const MeshPtr mesh = node.leafMesh())
  {
    std::string hash = node.parameters().getString("mesh");
    const bool known = std::any_of(
      meshes.begin(), meshes.end(), [&](const auto& entry) { return entry.first == hash; });
    if (!known)
    {
      meshes.emplace_back(std::move(hash), mesh);
    }
  }
  for (const NodePtr& child : node.children())
  {
    collectMeshes(*child, seen, meshes);
  }
}

} // namespace

std::string toText(const Node& root)
{
  Writer writer;
  writer.add(root);
  const Json document = { { "format", kFormat }, { "version", kVersion },
    { "nodes", writer.takeTable() } };
  return document.dump();
}

NodePtr fromText(const std::string& text, const MeshLookup& lookup)
{
  try
  {
    const Json document = Json::parse(text);
    return Reader(lookup).read(tableOf(document));
  }
  catch (const Json::exception& error)
  {
    throw InvalidText("The text of the tree is not valid JSON: " + std::string(error.what()));
  }
}

std::vector<std::pair<std::string, MeshPtr>> meshesOf(const Node& root)
{
  std::unordered_set<const Node*> seen;
  std::vector<std::pair<std::string, MeshPtr>> meshes;
  collectMeshes(root, seen, meshes);
  return meshes;
}

} // namespace hybridtree
