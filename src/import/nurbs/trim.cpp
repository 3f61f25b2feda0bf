#include "import/nurbs/trim.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <set>

namespace imgeo::nurbs {

namespace {

/// A piece of a contour inside of one cell.
struct Segment {
  Parameters begin, end; ///< begin.x < end.x

  double at(double u) const {
    if (u == begin.x)
      return begin.y;
    if (u == end.x)
      return end.y;
    return begin.y + (end.y - begin.y) * ((u - begin.x) / (end.x - begin.x));
  }
  bool spans(double u) const { return begin.x <= u && u < end.x; }
};

/// What a contour leaves in a cell.
struct CutCell {
  std::vector<Segment> segments; ///< those that do not run along v
  std::set<double> us;           ///< of the corners of all pieces inside
};

class Trimmer {
public:
  Trimmer(const std::vector<double>& us, const std::vector<double>& vs) : us_(us), vs_(vs) {}

  void add(const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i)
      addEdge(clamped(loop[i]), clamped(loop[(i + 1) % loop.size()]));
  }

  std::vector<CellPolygon> polygons() {
    for (std::size_t column = 0; column + 1 < us_.size(); ++column)
      for (std::size_t row = 0; row + 1 < vs_.size(); ++row)
        addCell(column, row);
    for (CellPolygon& polygon : polygons_)
      polygon.corners = withCornersOfNeighbours(polygon.corners);
    return std::move(polygons_);
  }

private:
  Parameters clamped(Parameters p) const {
    return {std::clamp(p.x, us_.front(), us_.back()), std::clamp(p.y, vs_.front(), vs_.back())};
  }

  /// The index of the interval that contains a value.
  static std::size_t intervalOf(const std::vector<double>& values, double value) {
    const auto after = std::upper_bound(values.begin() + 1, values.end() - 1, value);
    return static_cast<std::size_t>(after - values.begin()) - 1;
  }

  /// Cuts an edge at the lines between cells.
  void addEdge(Parameters a, Parameters b) {
    if (b.x < a.x)
      std::swap(a, b);
    std::vector<Parameters> corners{a, b};
    for (auto u = std::ranges::upper_bound(us_, a.x); u != us_.end() && *u < b.x; ++u)
      corners.push_back({*u, a.y + (b.y - a.y) * ((*u - a.x) / (b.x - a.x))});
    const auto [low, high] = std::minmax(a.y, b.y);
    for (auto v = std::ranges::upper_bound(vs_, low); v != vs_.end() && *v < high; ++v)
      corners.push_back({a.x + (b.x - a.x) * ((*v - a.y) / (b.y - a.y)), *v});
    std::ranges::sort(corners, [&](const Parameters& p, const Parameters& q) {
      return p.x != q.x ? p.x < q.x : a.y < b.y ? p.y < q.y : p.y > q.y;
    });
    for (std::size_t i = 1; i < corners.size(); ++i)
      addPiece(corners[i - 1], corners[i]);
  }

  void addPiece(Parameters a, Parameters b) {
    const std::size_t column = intervalOf(us_, (a.x + b.x) / 2), row = intervalOf(vs_, (a.y + b.y) / 2);
    CutCell& cell = cut_[column][row];
    cell.us.insert({a.x, b.x});
    if (a.x < b.x)
      cell.segments.push_back({a, b});
  }

  /// Whether a point just above the lower edge of a cell lies within an odd number of loops.
  bool isInsideAtBottom(std::size_t column, std::size_t row, double u) const {
    const auto cells = cut_.find(column);
    std::size_t crossed = 0;
    if (cells != cut_.end())
      for (auto cell = cells->second.begin(); cell != cells->second.end() && cell->first < row; ++cell)
        for (const Segment& segment : cell->second.segments)
          crossed += segment.spans(u) ? 1 : 0;
    return crossed % 2 == 1;
  }

  void addCell(std::size_t column, std::size_t row) {
    const double left = us_[column], right = us_[column + 1], bottom = vs_[row], top = vs_[row + 1];
    const auto cells = cut_.find(column);
    const CutCell* cut = nullptr;
    if (cells != cut_.end())
      if (const auto found = cells->second.find(row); found != cells->second.end())
        cut = &found->second;
    if (cut == nullptr) {
      if (isInsideAtBottom(column, row, (left + right) / 2))
        polygons_.push_back({column, row, {{left, bottom}, {right, bottom}, {right, top}, {left, top}}});
      return;
    }
    std::set<double> slabs = cut->us;
    slabs.insert({left, right});
    for (auto begin = slabs.begin(), end = std::next(begin); end != slabs.end(); begin = end++)
      addSlab(column, row, *cut, *begin, *end);
  }

  /// Adds the trapezoids of a cell between two values of u; no piece of a contour has a corner between them.
  void addSlab(std::size_t column, std::size_t row, const CutCell& cut, double begin, double end) {
    const double middle = (begin + end) / 2, bottom = vs_[row], top = vs_[row + 1];
    std::vector<const Segment*> across;
    for (const Segment& segment : cut.segments)
      if (segment.spans(middle))
        across.push_back(&segment);
    std::ranges::sort(across, {}, [&](const Segment* segment) { return segment->at(middle); });
    bool isInside = isInsideAtBottom(column, row, middle);
    const Segment bottomEdge{{begin, bottom}, {end, bottom}}, topEdge{{begin, top}, {end, top}};
    const Segment* low = &bottomEdge;
    across.push_back(&topEdge);
    for (const Segment* high : across) {
      if (isInside)
        addTrapezoid(column, row, begin, end, *low, *high);
      isInside = !isInside;
      low = high;
    }
  }

  void addTrapezoid(std::size_t column, std::size_t row, double begin, double end, const Segment& low,
                    const Segment& high) {
    std::vector<Parameters> corners;
    const auto add = [&](double u, const Segment& edge) {
      const Parameters corner{u, std::clamp(edge.at(u), vs_[row], vs_[row + 1])};
      if (corners.empty() || (corner != corners.back() && corner != corners.front()))
        corners.push_back(corner);
    };
    add(begin, low);
    add(end, low);
    add(end, high);
    add(begin, high);
    if (corners.size() < 3)
      return;
    for (const Parameters& corner : corners) {
      alongU_[corner.y].insert(corner.x);
      alongV_[corner.x].insert(corner.y);
    }
    polygons_.push_back({column, row, std::move(corners)});
  }

  /// Adds the corners of other polygons that lie on edges along u or v.
  std::vector<Parameters> withCornersOfNeighbours(const std::vector<Parameters>& corners) const {
    std::vector<Parameters> all;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Parameters from = corners[i], to = corners[(i + 1) % corners.size()];
      all.push_back(from);
      if (from.x == to.x)
        for (const double v : valuesBetween(alongV_, from.x, from.y, to.y))
          all.push_back({from.x, v});
      else if (from.y == to.y)
        for (const double u : valuesBetween(alongU_, from.y, from.x, to.x))
          all.push_back({u, from.y});
    }
    return all;
  }

  using Lines = std::map<double, std::set<double>>;

  /// The values of a line strictly between two of them, in the direction from the first to the second.
  static std::vector<double> valuesBetween(const Lines& lines, double line, double from, double to) {
    const auto found = lines.find(line);
    if (found == lines.end())
      return {};
    const auto [low, high] = std::minmax(from, to);
    std::vector<double> between(found->second.upper_bound(low), found->second.lower_bound(high));
    if (from > to)
      std::ranges::reverse(between);
    return between;
  }

  const std::vector<double>&us_, &vs_;
  std::map<std::size_t, std::map<std::size_t, CutCell>> cut_; ///< by column and row
  Lines alongU_, alongV_;                                     ///< corners of polygons in cut cells: u by v, and v by u
  std::vector<CellPolygon> polygons_;
};

} // namespace

std::vector<CellPolygon> cells(const std::vector<double>& us, const std::vector<double>& vs,
                               const std::vector<Loop>& loops) {
  assert(us.size() >= 2 && vs.size() >= 2);
  if (!loops.empty()) {
    Trimmer trimmer(us, vs);
    for (const Loop& loop : loops)
      trimmer.add(loop);
    return trimmer.polygons();
  }
  std::vector<CellPolygon> all;
  for (std::size_t column = 0; column + 1 < us.size(); ++column)
    for (std::size_t row = 0; row + 1 < vs.size(); ++row)
      all.push_back({column,
                     row,
                     {{us[column], vs[row]},
                      {us[column + 1], vs[row]},
                      {us[column + 1], vs[row + 1]},
                      {us[column], vs[row + 1]}}});
  return all;
}

} // namespace imgeo::nurbs
