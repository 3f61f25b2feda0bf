// compare(): matches the elements of an input and of a site.

#include "transcode/verify/element_list.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

namespace imgeo {

namespace {

/// An element and the lattice points of its corners, rotated so that equal elements have equal points: the smallest
/// rotation in lexicographical order. Rotations of a line are its two directions.
struct LatticeElement {
  std::array<Vec3u, 3> points;
  std::uint32_t element = 0;
};

bool less(const LatticeElement& a, const LatticeElement& b) {
  return std::ranges::lexicographical_compare(a.points, b.points, precedes);
}

/// Rotates every element of the list as described above and returns them sorted by their points.
std::vector<LatticeElement> sortedElements(ElementList& list) {
  std::vector<LatticeElement> elements(list.elements.size());
  for (std::uint32_t i = 0; i < elements.size(); ++i) {
    auto& corners = list.elements[i];
    LatticeElement smallest;
    std::uint32_t turns = 0;
    for (std::uint32_t turn = 0; turn < list.cornerCount; ++turn) {
      LatticeElement turned{{}, i};
      for (std::uint32_t c = 0; c < list.cornerCount; ++c)
        turned.points[c] = list.positions[corners[(c + turn) % list.cornerCount]];
      if (turn == 0 || less(turned, smallest))
        smallest = turned, turns = turn;
    }
    std::rotate(corners.begin(), corners.begin() + turns, corners.begin() + list.cornerCount);
    elements[i] = smallest;
  }
  std::ranges::sort(elements, [](const LatticeElement& a, const LatticeElement& b) {
    return less(a, b) || (!less(b, a) && a.element < b.element);
  });
  return elements;
}

/// A further attribute that both lists have, and the allowed difference of each component.
struct NamedPair {
  const NamedAttribute& input;
  const NamedAttribute& site;
  std::vector<double> bounds;
};

class Matcher {
public:
  Matcher(const ElementList& input, const ElementList& site, const AttributeBounds& bounds)
      : input_(input), site_(site), bounds_(bounds), normals_(!input.normals.empty() && !site.normals.empty()),
        texCoordSets_(std::min(texCoordSetCount(input), texCoordSetCount(site))),
        colors_(!input.colors.empty() && !site.colors.empty()) {
    for (const NamedAttribute& attribute : input.namedAttributes) {
      const auto other = std::ranges::find(site.namedAttributes, attribute.name, &NamedAttribute::name);
      const auto bound = bounds.named.find(attribute.name);
      if (other != site.namedAttributes.end() && other->components == attribute.components &&
          bound != bounds.named.end())
        named_.push_back({attribute, *other, bound->second});
    }
  }

  /// Compares the elements of both lists that lie on the same lattice points, in both directions.
  void match(std::span<const LatticeElement> inputs, std::span<const LatticeElement> sites,
             ElementDifference& worst) const {
    const bool collapsed = inputs.front().points[0] == inputs.front().points[input_.cornerCount - 1];
    const std::size_t turns = collapsed ? input_.cornerCount : 1;
    const std::vector<std::uint32_t> ofInput = distinct(input_, inputs), ofSite = distinct(site_, sites);
    if (ofInput.size() == 1 && ofSite.size() == 1) {
      addDifference(nearest(ofInput.front(), sortedCandidates(site_, ofSite, 1), site_, input_, turns), worst);
      return;
    }
    const std::vector<Candidate> siteCandidates = sortedCandidates(site_, ofSite, turns),
                                 inputCandidates = sortedCandidates(input_, ofInput, turns);
    for (const std::uint32_t element : ofInput)
      addDifference(nearest(element, siteCandidates, site_, input_, 1), worst);
    for (const std::uint32_t element : ofSite)
      addDifference(nearest(element, inputCandidates, input_, site_, 1), worst);
  }

private:
  /// An element rotated by `turn` corners. `key` is its coordinate along one axis of attribute space: the cost of a
  /// pair of elements is at least the difference of their keys.
  struct Candidate {
    double key;
    std::uint32_t element;
    std::uint32_t turn;
  };

  double key(const ElementList& list, std::uint32_t element, std::uint32_t turn) const {
    const std::uint32_t vertex = list.elements[element][turn];
    if (normals_)
      return list.normals[vertex].x * (180 / std::numbers::pi) / bounds_.normalDegrees;
    if (texCoordSets_ > 0)
      return list.texCoords[vertex].x / bounds_.texCoords[0].x;
    if (colors_)
      return list.colors[vertex].r / bounds_.color;
    if (!named_.empty()) {
      const NamedPair& pair = named_.front();
      const NamedAttribute& attribute = &list == &input_ ? pair.input : pair.site;
      return attribute.values[std::size_t{vertex} * attribute.components] / divisor(pair.bounds[0]);
    }
    return 0;
  }

  /// Indices of the elements, each combination of vertices once: a mesh may repeat an element a hundred thousand times.
  static std::vector<std::uint32_t> distinct(const ElementList& list, std::span<const LatticeElement> coincident) {
    std::vector<std::uint32_t> elements;
    for (const LatticeElement& one : coincident)
      elements.push_back(one.element);
    const auto verticesOf = [&](std::uint32_t element) { return list.elements[element]; };
    if (elements.size() > 1) {
      std::ranges::sort(elements, {}, verticesOf);
      const auto rest = std::ranges::unique(elements, {}, verticesOf);
      elements.erase(rest.begin(), rest.end());
    }
    return elements;
  }

  std::vector<Candidate> sortedCandidates(const ElementList& list, const std::vector<std::uint32_t>& elements,
                                          std::size_t turns) const {
    std::vector<Candidate> candidates;
    for (const std::uint32_t element : elements)
      for (std::uint32_t turn = 0; turn < turns; ++turn)
        candidates.push_back({key(list, element, turn), element, turn});
    std::ranges::sort(candidates, {}, &Candidate::key);
    return candidates;
  }

  /// The candidate of the other list with the smallest cost. Searches outwards from the element's key and stops where
  /// the difference of keys exceeds the smallest cost.
  AttributeDifference nearest(std::uint32_t element, const std::vector<Candidate>& candidates,
                              const ElementList& others, const ElementList& own, std::size_t ownTurns) const {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    AttributeDifference best{180, {}, infinity, infinity}; // the result if every cost is NaN
    best.texCoords.fill({infinity, infinity});
    double bestCost = infinity;
    for (std::uint32_t ownTurn = 0; ownTurn < ownTurns; ++ownTurn) {
      const double ownKey = key(own, element, ownTurn);
      const auto tryOne = [&](const Candidate& candidate) {
        if (std::abs(candidate.key - ownKey) > bestCost)
          return false;
        const AttributeDifference distance = between(own, element, ownTurn, others, candidate.element, candidate.turn);
        if (const double c = cost(distance, bounds_); c < bestCost)
          bestCost = c, best = distance;
        return bestCost > 0;
      };
      const auto middle = std::ranges::lower_bound(candidates, ownKey, {}, &Candidate::key);
      for (auto up = middle; up != candidates.end() && tryOne(*up);)
        ++up;
      for (auto down = middle; down != candidates.begin() && tryOne(*(down - 1));)
        --down;
    }
    return best;
  }

  AttributeDifference between(const ElementList& a, std::uint32_t elementA, std::uint32_t turnA, const ElementList& b,
                              std::uint32_t elementB, std::uint32_t turnB) const {
    AttributeDifference distance;
    for (std::uint32_t corner = 0; corner < a.cornerCount; ++corner) {
      const std::uint32_t va = a.elements[elementA][(corner + turnA) % a.cornerCount];
      const std::uint32_t vb = b.elements[elementB][(corner + turnB) % b.cornerCount];
      if (normals_)
        distance.normalDegrees =
            std::max(distance.normalDegrees, angleDegrees(Vec3d(a.normals[va]), Vec3d(b.normals[vb])));
      for (std::size_t set = 0; set < texCoordSets_; ++set) {
        const Vec2f ta = texCoordsOf(a, set)[va], tb = texCoordsOf(b, set)[vb];
        addToWorst({std::abs(double{ta.x} - tb.x), std::abs(double{ta.y} - tb.y)}, distance.texCoords[set]);
      }
      if (colors_)
        distance.color = std::max(distance.color, between(a.colors[va], b.colors[vb]));
      const bool isInput = &a == &input_;
      for (const NamedPair& pair : named_)
        distance.named = std::max(distance.named, between(pair, isInput ? va : vb, isInput ? vb : va));
    }
    return distance;
  }

  static double between(const Rgba& a, const Rgba& b) {
    return std::max({std::abs(double{a.r} - b.r), std::abs(double{a.g} - b.g), std::abs(double{a.b} - b.b),
                     std::abs(double{a.a} - b.a)});
  }

  static double between(const NamedPair& pair, std::uint32_t inputVertex, std::uint32_t siteVertex) {
    const std::size_t components = pair.input.components;
    double distance = 0;
    for (std::size_t c = 0; c < components; ++c)
      distance = std::max(distance, std::abs(double{pair.input.values[inputVertex * components + c]} -
                                             pair.site.values[siteVertex * components + c]) /
                                        divisor(pair.bounds[c]));
    return distance;
  }

  void addDifference(const AttributeDifference& distance, ElementDifference& worst) const {
    addToWorst(distance, worst);
    worst.colorsDiffering += colors_ && distance.color > bounds_.color;
  }

  const ElementList& input_;
  const ElementList& site_;
  const AttributeBounds& bounds_;
  bool normals_;
  std::size_t texCoordSets_;
  bool colors_;
  std::vector<NamedPair> named_;
};

/// The elements on the same lattice points as `sorted[begin]`, which are its successors.
std::span<const LatticeElement> coincidentFrom(const std::vector<LatticeElement>& sorted, std::size_t begin) {
  std::size_t end = begin + 1;
  while (end < sorted.size() && sorted[end].points == sorted[begin].points)
    ++end;
  return std::span(sorted).subspan(begin, end - begin);
}

} // namespace

ElementDifference compare(ElementList input, ElementList site, const AttributeBounds& bounds) {
  const std::vector<LatticeElement> inputs = sortedElements(input), sites = sortedElements(site);
  const Matcher matcher(input, site, bounds);
  ElementDifference difference;
  std::size_t i = 0, s = 0;
  while (i < inputs.size() || s < sites.size()) {
    const bool onlySite = i == inputs.size() || (s < sites.size() && less(sites[s], inputs[i]));
    const bool onlyInput = !onlySite && (s == sites.size() || less(inputs[i], sites[s]));
    const auto ofInput = onlySite ? std::span<const LatticeElement>{} : coincidentFrom(inputs, i);
    const auto ofSite = onlyInput ? std::span<const LatticeElement>{} : coincidentFrom(sites, s);
    std::size_t allowed = ofInput.size();
    if (!input.copies.empty()) {
      allowed = 0;
      for (const LatticeElement& one : ofInput)
        allowed += input.copies[one.element];
    }
    difference.missing += ofInput.size() - std::min(ofInput.size(), ofSite.size());
    difference.extra += ofSite.size() - std::min(allowed, ofSite.size());
    if (!ofInput.empty() && !ofSite.empty())
      matcher.match(ofInput, ofSite, difference);
    i += ofInput.size();
    s += ofSite.size();
  }
  return difference;
}

} // namespace imgeo
