#include "transcode/verify/element_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace imgeo {

namespace {

/// The lattice points of an element's corners, turned so that equal elements
/// have equal places: the least of its rotations, which for a line are its directions.
struct Place {
  std::array<Vec3u, 3> points;
  std::uint32_t element = 0;
};

bool less(const Place& a, const Place& b) {
  return std::ranges::lexicographical_compare(a.points, b.points, precedes);
}

/// Turns every element into its least rotation and sorts them by place.
std::vector<Place> placesOf(ElementList& list) {
  std::vector<Place> places(list.elements.size());
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    auto& corners = list.elements[i];
    Place least;
    std::uint32_t turns = 0;
    for (std::uint32_t turn = 0; turn < list.cornerCount; ++turn) {
      Place place{{}, i};
      for (std::uint32_t c = 0; c < list.cornerCount; ++c)
        place.points[c] = list.positions[corners[(c + turn) % list.cornerCount]];
      if (turn == 0 || less(place, least))
        least = place, turns = turn;
    }
    std::rotate(corners.begin(), corners.begin() + turns, corners.begin() + list.cornerCount);
    places[i] = least;
  }
  std::ranges::sort(
      places, [](const Place& a, const Place& b) { return less(a, b) || (!less(b, a) && a.element < b.element); });
  return places;
}

double angleDegrees(Vec3f a, Vec3f b) {
  const Vec3d p(a), q(b);
  return std::atan2(length(cross(p, q)), dot(p, q)) * (180 / std::numbers::pi);
}

/// How far an element of the input and one of the site are apart.
struct Distance {
  double normalDegrees = 0;
  Vec2<double> texCoord;
  double named = 0; ///< in parts of what is allowed
  bool colorsDiffer = false;
};

/// An attribute of both lists, and what its components may differ by.
struct NamedPair {
  const NamedAttribute& input;
  const NamedAttribute& site;
  std::vector<double> bounds;
};

class Matcher {
public:
  Matcher(const ElementList& input, const ElementList& site, const AttributeBounds& bounds)
      : input_(input), site_(site), bounds_(bounds), normals_(!input.normals.empty() && !site.normals.empty()),
        texCoords_(!input.texCoords.empty() && !site.texCoords.empty()),
        colors_(!input.colors.empty() && !site.colors.empty()) {
    for (const NamedAttribute& attribute : input.namedAttributes) {
      const auto other = std::ranges::find(site.namedAttributes, attribute.name, &NamedAttribute::name);
      const auto bound = bounds.named.find(attribute.name);
      if (other != site.namedAttributes.end() && other->components == attribute.components &&
          bound != bounds.named.end())
        named_.push_back({attribute, *other, bound->second});
    }
  }

  /// Measures the elements at one place, in both directions.
  void match(std::span<const Place> inputs, std::span<const Place> sites, ElementDifference& worst) const {
    const bool collapsed = inputs.front().points[0] == inputs.front().points[input_.cornerCount - 1];
    const std::size_t turns = collapsed ? input_.cornerCount : 1;
    const std::vector<std::uint32_t> ofInput = distinct(input_, inputs), ofSite = distinct(site_, sites);
    if (ofInput.size() == 1 && ofSite.size() == 1) {
      note(nearest(ofInput.front(), sorted(site_, ofSite, 1), site_, input_, turns), worst);
      return;
    }
    const std::vector<Candidate> siteOrder = sorted(site_, ofSite, turns), inputOrder = sorted(input_, ofInput, turns);
    for (const std::uint32_t element : ofInput)
      note(nearest(element, siteOrder, site_, input_, 1), worst);
    for (const std::uint32_t element : ofSite)
      note(nearest(element, inputOrder, input_, site_, 1), worst);
  }

private:
  /// An element turned by `turn` corners, and where it lies along an axis of
  /// attribute space: two elements are at least as far apart as their keys.
  struct Candidate {
    double key;
    std::uint32_t element;
    std::uint32_t turn;
  };

  double key(const ElementList& list, std::uint32_t element, std::uint32_t turn) const {
    const std::uint32_t vertex = list.elements[element][turn];
    if (normals_)
      return list.normals[vertex].x * (180 / std::numbers::pi) / bounds_.normalDegrees;
    if (texCoords_)
      return list.texCoords[vertex].x / bounds_.texCoord.x;
    if (colors_)
      return list.colors[vertex].r;
    if (!named_.empty()) {
      const NamedPair& pair = named_.front();
      const NamedAttribute& attribute = &list == &input_ ? pair.input : pair.site;
      return attribute.values[std::size_t{vertex} * attribute.components] / allowed(pair.bounds[0]);
    }
    return 0;
  }

  /// Of elements of the same vertices one: a mesh may have one of them a hundred thousand times.
  static std::vector<std::uint32_t> distinct(const ElementList& list, std::span<const Place> places) {
    std::vector<std::uint32_t> elements;
    for (const Place& place : places)
      elements.push_back(place.element);
    const auto verticesOf = [&](std::uint32_t element) { return list.elements[element]; };
    if (elements.size() > 1) {
      std::ranges::sort(elements, {}, verticesOf);
      const auto rest = std::ranges::unique(elements, {}, verticesOf);
      elements.erase(rest.begin(), rest.end());
    }
    return elements;
  }

  std::vector<Candidate> sorted(const ElementList& list, const std::vector<std::uint32_t>& elements,
                                std::size_t turns) const {
    std::vector<Candidate> candidates;
    for (const std::uint32_t element : elements)
      for (std::uint32_t turn = 0; turn < turns; ++turn)
        candidates.push_back({key(list, element, turn), element, turn});
    std::ranges::sort(candidates, {}, &Candidate::key);
    return candidates;
  }

  /// The best fit to one element among candidates of the other list: looks
  /// outwards from the element's key until no key can be nearer.
  Distance nearest(std::uint32_t element, const std::vector<Candidate>& candidates, const ElementList& others,
                   const ElementList& own, std::size_t ownTurns) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Distance best{180, {infinity, infinity}, infinity, true}; // stands where nothing can be compared: a NaN
    double bestCost = infinity;
    for (std::uint32_t ownTurn = 0; ownTurn < ownTurns; ++ownTurn) {
      const double here = key(own, element, ownTurn);
      const auto tryOne = [&](const Candidate& candidate) {
        if (std::abs(candidate.key - here) > bestCost)
          return false;
        const Distance distance = between(own, element, ownTurn, others, candidate.element, candidate.turn);
        if (const double c = cost(distance); c < bestCost)
          bestCost = c, best = distance;
        return bestCost > 0;
      };
      const auto middle = std::ranges::lower_bound(candidates, here, {}, &Candidate::key);
      for (auto up = middle; up != candidates.end() && tryOne(*up);)
        ++up;
      for (auto down = middle; down != candidates.begin() && tryOne(*(down - 1));)
        --down;
    }
    return best;
  }

  Distance between(const ElementList& a, std::uint32_t elementA, std::uint32_t turnA, const ElementList& b,
                   std::uint32_t elementB, std::uint32_t turnB) const {
    Distance distance;
    for (std::uint32_t corner = 0; corner < a.cornerCount; ++corner) {
      const std::uint32_t va = a.elements[elementA][(corner + turnA) % a.cornerCount];
      const std::uint32_t vb = b.elements[elementB][(corner + turnB) % b.cornerCount];
      if (normals_)
        distance.normalDegrees = std::max(distance.normalDegrees, angleDegrees(a.normals[va], b.normals[vb]));
      if (texCoords_) {
        const Vec2<double> ta{a.texCoords[va].x, a.texCoords[va].y}, tb{b.texCoords[vb].x, b.texCoords[vb].y};
        distance.texCoord.x = std::max(distance.texCoord.x, std::abs(ta.x - tb.x));
        distance.texCoord.y = std::max(distance.texCoord.y, std::abs(ta.y - tb.y));
      }
      if (colors_)
        distance.colorsDiffer |= a.colors[va] != b.colors[vb];
      const bool isInput = &a == &input_;
      for (const NamedPair& pair : named_)
        distance.named = std::max(distance.named, between(pair, isInput ? va : vb, isInput ? vb : va));
    }
    return distance;
  }

  static double between(const NamedPair& pair, std::uint32_t inputVertex, std::uint32_t siteVertex) {
    const std::size_t components = pair.input.components;
    double distance = 0;
    for (std::size_t c = 0; c < components; ++c)
      distance = std::max(distance, std::abs(double{pair.input.values[inputVertex * components + c]} -
                                             pair.site.values[siteVertex * components + c]) /
                                        allowed(pair.bounds[c]));
    return distance;
  }

  /// What is stored exactly may differ by nothing.
  static double allowed(double bound) { return std::max(bound, 1e-300); }

  /// 1 and less is within bounds. Colours are stored exactly: one step off
  /// outweighs what their keys may be apart.
  double cost(const Distance& distance) const {
    double cost = std::max(distance.colorsDiffer ? 256.0 : 0.0, distance.named);
    if (normals_)
      cost = std::max(cost, distance.normalDegrees / bounds_.normalDegrees);
    if (texCoords_)
      cost = std::max({cost, distance.texCoord.x / bounds_.texCoord.x, distance.texCoord.y / bounds_.texCoord.y});
    return cost;
  }

  static void note(const Distance& distance, ElementDifference& worst) {
    worst.normalDegrees = std::max(worst.normalDegrees, distance.normalDegrees);
    worst.texCoord.x = std::max(worst.texCoord.x, distance.texCoord.x);
    worst.texCoord.y = std::max(worst.texCoord.y, distance.texCoord.y);
    worst.named = std::max(worst.named, distance.named);
    worst.colorsDiffering += distance.colorsDiffer;
  }

  const ElementList& input_;
  const ElementList& site_;
  const AttributeBounds& bounds_;
  bool normals_, texCoords_, colors_;
  std::vector<NamedPair> named_;
};

/// The elements of `places` at the place of `places[begin]`.
std::span<const Place> samePlace(const std::vector<Place>& places, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < places.size() && places[end].points == places[begin].points)
    ++end;
  return std::span(places).subspan(begin, end - begin);
}

} // namespace

ElementDifference compare(const ElementList& inputAsGiven, const ElementList& siteAsGiven,
                          const AttributeBounds& bounds) {
  ElementList input = inputAsGiven, site = siteAsGiven;
  const std::vector<Place> inputs = placesOf(input), sites = placesOf(site);
  const Matcher matcher(input, site, bounds);
  ElementDifference difference;
  std::size_t i = 0, s = 0;
  while (i < inputs.size() || s < sites.size()) {
    const bool onlySite = i == inputs.size() || (s < sites.size() && less(sites[s], inputs[i]));
    const bool onlyInput = !onlySite && (s == sites.size() || less(inputs[i], sites[s]));
    const auto here = onlySite ? std::span<const Place>{} : samePlace(inputs, i);
    const auto there = onlyInput ? std::span<const Place>{} : samePlace(sites, s);
    std::size_t allowed = here.size();
    if (!input.copies.empty()) {
      allowed = 0;
      for (const Place& place : here)
        allowed += input.copies[place.element];
    }
    difference.missing += here.size() - std::min(here.size(), there.size());
    difference.extra += there.size() - std::min(allowed, there.size());
    if (!here.empty() && !there.empty())
      matcher.match(here, there, difference);
    i += here.size();
    s += there.size();
  }
  return difference;
}

} // namespace imgeo
