#include "import/gltf/animations.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string_view>
#include <tuple>

namespace imgeo::gltf {

namespace {

/// The field that a channel's path names; empty for pointers, and paths of later versions.
std::optional<AnimatedField> fieldOfPath(const std::string& path) {
  if (path == "translation")
    return AnimatedField::translation;
  if (path == "rotation")
    return AnimatedField::rotation;
  if (path == "scale")
    return AnimatedField::scale;
  if (path == "weights")
    return AnimatedField::weights;
  return std::nullopt;
}

/// Whether a field is one of a node's transform.
bool movesNode(std::optional<AnimatedField> field) {
  return field && *field != AnimatedField::weights;
}

/// The keys of one of `count` displacers: samplers of glTF hold the weights of all of them for each key.
AnimationKeys keysOfDisplacer(const AnimationKeys& all, std::size_t displacer, std::size_t count) {
  AnimationKeys keys{all.interpolation, all.seconds, {}, 1};
  for (std::size_t i = displacer; i < all.values.size(); i += count)
    keys.values.push_back(all.values[i]);
  return keys;
}

struct PointedNode {
  std::size_t node = 0;
  AnimatedField field = AnimatedField::translation;
};

/// What KHR_animation_pointer names, where it is animated as a property of a node: "/nodes/3/rotation".
std::optional<PointedNode> pointedNode(const Value& target) {
  const std::string pointer = target["extensions"]["KHR_animation_pointer"]["pointer"].text();
  constexpr std::string_view prefix = "/nodes/";
  if (!pointer.starts_with(prefix))
    return std::nullopt;
  PointedNode pointed;
  const char* const end = pointer.data() + pointer.size();
  const auto [rest, error] = std::from_chars(pointer.data() + prefix.size(), end, pointed.node);
  if (error != std::errc() || rest == end || *rest != '/')
    return std::nullopt;
  const std::optional<AnimatedField> field = fieldOfPath({rest + 1, end});
  if (!field)
    return std::nullopt;
  pointed.field = *field;
  return pointed;
}

KeyInterpolation interpolationOf(const Value& sampler) {
  const std::string name = sampler["interpolation"].text("LINEAR");
  if (name == "LINEAR")
    return KeyInterpolation::linear;
  if (name == "STEP")
    return KeyInterpolation::step;
  if (name != "CUBICSPLINE")
    sampler["interpolation"].fail(ErrorKind::malformed, "is none of LINEAR, STEP and CUBICSPLINE");
  return KeyInterpolation::cubicSpline;
}

} // namespace

std::set<std::size_t> movedNodes(Document& document) {
  std::set<std::size_t> moved;
  const Value animations = document.array("animations"), nodes = document.array("nodes");
  for (std::size_t a = 0; a < animations.size(); ++a)
    for (std::size_t c = 0; c < animations[a]["channels"].size(); ++c) {
      const Value target = animations[a]["channels"][c]["target"];
      if (const std::optional<PointedNode> pointed = pointedNode(target)) {
        if (movesNode(pointed->field) && pointed->node < nodes.size() && !nodes[pointed->node].has("matrix"))
          moved.insert(pointed->node);
        continue;
      }
      if (!target["path"].json().is_string() || !movesNode(fieldOfPath(target["path"].text())) ||
          !target["node"].json().is_number_unsigned())
        continue;
      if (const std::uint64_t node = target["node"].whole(); node < nodes.size() && !nodes[node].has("matrix"))
        moved.insert(node);
    }
  return moved;
}

template <typename Read> void AnimationReader::attempt(const Read& read) {
  try {
    read();
  } catch (const Error& error) {
    if (isStrict_ || error.kind() == ErrorKind::limit)
      throw;
    omissions.damage.push_back(fmt::format("Left out: {}.", error.what()));
  }
}

void AnimationReader::read(const AnimatedNodes& nodes) {
  const Value animations = document_.array("animations");
  for (std::size_t i = 0; i < animations.size(); ++i)
    attempt([&] { readAnimation(animations[i], nodes); });
}

void AnimationReader::readAnimation(const Value& animation, const AnimatedNodes& nodes) {
  const Value channels = animation["channels"], samplers = animation["samplers"];
  struct ChannelKeys {
    Channel channel;
    const std::vector<AnimationKeys>* keys;
  };
  std::vector<ChannelKeys> read;
  std::map<std::tuple<std::size_t, AnimatedField, std::size_t>, std::vector<AnimationKeys>> keys;
  double seconds = 0;
  for (std::size_t i = 0; i < channels.size(); ++i)
    attempt([&] {
      const std::optional<Channel> channel = channelOf(channels[i], samplers, nodes);
      if (!channel)
        return;
      const std::tuple key{channel->sampler, channel->field, channel->nodes.size()};
      auto found = keys.find(key);
      if (found == keys.end())
        found = keys.emplace(key, keysOf(samplers[channel->sampler], channel->field, channel->nodes.size())).first;
      seconds = std::max<double>(seconds, found->second.front().seconds.back());
      read.push_back({*channel, &found->second});
    });
  if (read.empty())
    return;
  builder_.begin(animation["name"].text(), seconds);
  for (const auto& [channel, channelKeys] : read)
    for (std::size_t i = 0; i < channel.nodes.size(); ++i)
      builder_.animate(channel.nodes[i], channel.field, (*channelKeys)[i], &(*channelKeys)[i]);
}

std::optional<AnimationReader::Channel> AnimationReader::channelOf(const Value& channel, const Value& samplers,
                                                                   const AnimatedNodes& nodes) {
  const Value target = channel["target"];
  const std::optional<PointedNode> pointed = pointedNode(target);
  const std::optional<AnimatedField> field = pointed ? pointed->field : fieldOfPath(target["path"].text());
  if (!field) {
    ++omissions.otherPaths;
    return {};
  }
  const Value all = document_.array("nodes");
  const std::optional<std::size_t> node = pointed ? pointed->node : target.index("node", all);
  if (pointed && pointed->node >= all.size())
    target.fail(ErrorKind::malformed, fmt::format("names node {} of {}", pointed->node, all.size()));
  if (!node) // the extension that says what else is animated is not known
    return {};
  if (movesNode(field) && all[*node].has("matrix"))
    target["node"].fail(ErrorKind::malformed, "names a node with a matrix, which cannot be animated");
  const std::optional<std::size_t> sampler = channel.index("sampler", samplers);
  if (!sampler)
    channel["sampler"].fail(ErrorKind::malformed, "is missing");
  // A node that is not found is in another scene of the file, or left out.
  if (!movesNode(field)) {
    const auto found = nodes.displacers.find(*node);
    return found == nodes.displacers.end() ? std::nullopt : std::optional(Channel{found->second, *sampler, *field});
  }
  const auto found = nodes.transforms.find(*node);
  return found == nodes.transforms.end() ? std::nullopt : std::optional(Channel{{found->second}, *sampler, *field});
}

/// The keys for each of the nodes that the field belongs to.
std::vector<AnimationKeys> AnimationReader::keysOf(const Value& sampler, AnimatedField field, std::size_t nodeCount) {
  const auto accessorOf = [&](const char* name) {
    const std::optional<std::size_t> index = sampler.index(name, document_.array("accessors"));
    if (!index)
      sampler[name].fail(ErrorKind::malformed, "is missing");
    return document_.accessor(*index);
  };
  const Accessor input = accessorOf("input"), output = accessorOf("output");
  AnimationKeys keys;
  keys.interpolation = interpolationOf(sampler);
  keys.components = field == AnimatedField::rotation ? 4 : field == AnimatedField::weights ? 1 : 3;
  const std::size_t perKey = (keys.interpolation == KeyInterpolation::cubicSpline ? 3 : 1) * nodeCount;
  if (input.components() != 1 || input.count() == 0)
    sampler["input"].fail(ErrorKind::malformed, "holds no times");
  if (output.components() != keys.components || output.count() != perKey * input.count())
    sampler["output"].fail(ErrorKind::malformed, fmt::format("holds {} values of {} numbers for {} keys",
                                                             output.count(), output.components(), input.count()));
  document_.spend(sampler, (input.count() + output.count() * keys.components) * 4);
  for (std::size_t i = 0; i < input.count(); ++i) {
    const double seconds = input.real(i, 0);
    if (!std::isfinite(seconds) || seconds < 0 || (i > 0 && seconds <= keys.seconds.back()))
      sampler["input"].fail(ErrorKind::malformed, fmt::format("time {} is not later than the one before", i));
    keys.seconds.push_back(static_cast<float>(seconds));
  }
  for (std::size_t i = 0; i < output.count(); ++i)
    for (std::uint32_t c = 0; c < output.components(); ++c) {
      const double number = output.real(i, c);
      if (!std::isfinite(number))
        sampler["output"].fail(ErrorKind::malformed, fmt::format("value {} is not finite", i));
      keys.values.push_back(static_cast<float>(number));
    }
  if (field != AnimatedField::weights)
    return {std::move(keys)};
  std::vector<AnimationKeys> ofDisplacers;
  for (std::size_t i = 0; i < nodeCount; ++i)
    ofDisplacers.push_back(keysOfDisplacer(keys, i, nodeCount));
  return ofDisplacers;
}

} // namespace imgeo::gltf
