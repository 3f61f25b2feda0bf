#include "transcode/verify/compare_animations.h"

#include "import/format.h"
#include "import/warnings.h"
#include "transcode/verify/compare_gltf_animations.h"
#include "transcode/verify/findings.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <iterator>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace imgeo {

namespace {

template <typename Content> std::vector<std::size_t> nodesWith(const SceneGraph& graph) {
  std::vector<std::size_t> nodes = nodesInOrder(graph);
  std::erase_if(nodes, [&](std::size_t node) { return !std::holds_alternative<Content>(graph.nodes[node].content); });
  return nodes;
}

/// Equal but for the rounding of a sum.
bool isNear(double a, double b) {
  return std::abs(a - b) <= 1e-6 * std::max({1.0, std::abs(a), std::abs(b)});
}

bool isSame(const TimeSensor& a, const TimeSensor& b) {
  return a.enabled == b.enabled && a.loop == b.loop && isNear(a.cycleInterval, b.cycleInterval) &&
         isNear(a.startTime, b.startTime) && isNear(a.stopTime, b.stopTime) && isNear(a.pauseTime, b.pauseTime) &&
         isNear(a.resumeTime, b.resumeTime);
}

bool isSame(const Interpolator& a, const Interpolator& b) {
  return a.kind == b.kind && std::ranges::equal(a.keys, b.keys, isNear) &&
         std::ranges::equal(a.values, b.values, isNear);
}

/// A route between nodes that a site's reader keeps; nodes by their number among those of their kind.
using RouteKey = std::tuple<std::size_t, std::size_t, std::string, std::size_t, std::size_t, std::string>;

std::vector<RouteKey> routesOf(const SceneGraph& graph) {
  std::map<std::size_t, std::size_t> numbers; ///< by node
  std::map<std::size_t, std::size_t> counts;  ///< by kind
  for (const std::size_t node : nodesInOrder(graph))
    numbers[node] = counts[graph.nodes[node].content.index()]++;
  std::vector<RouteKey> keys;
  for (const Route& route : graph.routes) {
    const NodeContent &from = graph.nodes[route.fromNode].content, &to = graph.nodes[route.toNode].content;
    const auto isKept = [](const NodeContent& content) {
      return std::holds_alternative<TimeSensor>(content) || std::holds_alternative<Interpolator>(content);
    };
    const bool isNumbered = isKept(to) || std::holds_alternative<Displacer>(to);
    if (isKept(from) && isNumbered)
      keys.emplace_back(from.index(), numbers[route.fromNode], route.fromField, to.index(), numbers[route.toNode],
                        route.toField);
    else if (isKept(from) && std::holds_alternative<Transform>(to))
      keys.emplace_back(from.index(), numbers[route.fromNode], route.fromField, to.index(), 0, route.toField);
  }
  std::ranges::sort(keys);
  return keys;
}

template <typename Content>
void compareNodes(const SceneGraph& site, const SceneGraph& input, const char* plural, Findings& findings) {
  const std::vector<std::size_t> inSite = nodesWith<Content>(site), inInput = nodesWith<Content>(input);
  if (inSite.size() != inInput.size())
    return findings.add("The site has {} {}, the input {}.", inSite.size(), plural, inInput.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < inSite.size(); ++i)
    different +=
        !isSame(std::get<Content>(site.nodes[inSite[i]].content), std::get<Content>(input.nodes[inInput[i]].content));
  if (different > 0)
    findings.add("{} of {} {} differ from those of the input.", different, inSite.size(), plural);
}

/// The number of routes to or from imported nodes, which are kept as they are.
std::size_t keptRoutes(const SceneGraph& graph) {
  const std::vector<std::size_t> nodes = nodesInOrder(graph);
  return static_cast<std::size_t>(std::ranges::count_if(nodes, [&](std::size_t node) {
    const GenericNode* generic = std::get_if<GenericNode>(&graph.nodes[node].content);
    return generic && generic->element == "ROUTE";
  }));
}

void compareAllNodes(const SceneDocument& site, const SceneGraph& input, Findings& findings) {
  compareNodes<TimeSensor>(site.graph, input, "TimeSensors", findings);
  compareNodes<Interpolator>(site.graph, input, "interpolators", findings);
  const auto found = site.otherElements.find("ROUTE");
  const std::size_t routes = found == site.otherElements.end() ? 0 : found->second;
  if (const std::size_t expected = input.routes.size() + keptRoutes(input); routes != expected)
    findings.add("The site has {} routes, the input {}.", routes, expected);
  else if (routesOf(site.graph) != routesOf(input))
    findings.add("Routes of the site connect other nodes or fields than those of the input.");
}

/// "3 routes, 1 interpolator"; "" for nothing.
std::string listed(const BeyondGltf& beyond) {
  std::vector<std::string> parts;
  const auto add = [&](std::size_t count, const char* singular, const char* plural) {
    if (count > 0)
      parts.push_back(counted(count, singular, plural));
  };
  add(beyond.routes, "route", "routes");
  add(beyond.interpolators, "interpolator", "interpolators");
  add(beyond.timeSensors, "TimeSensor", "TimeSensors");
  if (beyond.clocks > 0)
    parts.push_back("when " + counted(beyond.clocks, "TimeSensor plays", "TimeSensors play"));
  return fmt::format("{}", fmt::join(parts, ", "));
}

} // namespace

void compareAnimations(const SceneDocument& site, const Imported& input, const SiteManifest& manifest,
                       VerifyReport& report) {
  const SceneGraph& graph = input.scene.graph;
  Findings findings(report);
  const bool isGltf = input.format == "glTF" || input.format == "GLB";
  if (isGltf && (manifest.source.empty() || hasX3dExtension(manifest.source))) {
    if (const std::string beyond = listed(compareGltfAnimations(site, graph, findings)); !beyond.empty())
      report.notCompared.push_back("Not compared, since glTF cannot express it: " + beyond + ".");
    return;
  }
  VerifyReport ofNodes, asGltf;
  Findings ofNodesFindings(ofNodes), asGltfFindings(asGltf);
  compareAllNodes(site, graph, ofNodesFindings);
  if (isGltf && !ofNodes.findings.empty() && listed(compareGltfAnimations(site, graph, asGltfFindings)).empty() &&
      asGltf.findings.empty())
    return;
  std::ranges::move(ofNodes.findings, std::back_inserter(report.findings));
}

} // namespace imgeo
