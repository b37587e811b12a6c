#include "TriangleField.hpp"
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace yade::nscd {

namespace {
	constexpr double onEdge = 1e-9; // of a share: how far beside a triangle a point may be by rounding
}

TriangleField::TriangleField(std::vector<Node> given, std::vector<Triangle> between)
        : nodes(std::move(given))
        , triangles(std::move(between))
{
	if (triangles.empty()) return;
	const auto refuse = [](size_t k, const std::string& why) {
		throw std::invalid_argument("triangles[" + std::to_string(k) + "] " + why);
	};
	double area = 0;
	twice.reserve(triangles.size());
	for (size_t k = 0; k < triangles.size(); ++k) {
		for (const int n : triangles[k])
			if (n < 0 || n >= (int)nodes.size())
				refuse(k,
				       "names the node " + std::to_string(n) + ", and there are "
				               + std::to_string(nodes.size()));
		const auto &a = nodes[triangles[k][0]], &b = nodes[triangles[k][1]], &c = nodes[triangles[k][2]];
		twice.push_back((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y));
		if (!(std::abs(twice.back()) > 0)) refuse(k, "has no area: its nodes stand in a line");
		area += std::abs(twice.back()) / 2;
	}
	double right = nodes[triangles[0][0]].x, high = nodes[triangles[0][0]].y;
	left = right, low = high;
	for (const auto& t : triangles)
		for (const int n : t) {
			left = std::min(left, nodes[n].x), right = std::max(right, nodes[n].x);
			low = std::min(low, nodes[n].y), high = std::max(high, nodes[n].y);
		}
	cell    = std::max(std::sqrt(2 * area / double(triangles.size())), 1e-4 * std::max(right - left, high - low));
	columns = int((right - left) / cell) + 1;
	rows    = int((high - low) / cell) + 1;
	// counted first, then filled in: cells know their triangles in the order of the list
	first.assign(size_t(columns) * rows + 1, 0);
	const auto each = [&](auto&& take) {
		for (size_t k = 0; k < triangles.size(); ++k) {
			const auto &a = nodes[triangles[k][0]], &b = nodes[triangles[k][1]],
			           &c       = nodes[triangles[k][2]];
			const double margin = onEdge * cell;
			const int    c0     = column(std::min({ a.x, b.x, c.x }) - margin),
			          c1        = column(std::max({ a.x, b.x, c.x }) + margin);
			const int r0        = row(std::min({ a.y, b.y, c.y }) - margin),
			          r1        = row(std::max({ a.y, b.y, c.y }) + margin);
			for (int r = r0; r <= r1; ++r)
				for (int q = c0; q <= c1; ++q)
					take(size_t(r) * columns + q, int(k));
		}
	};
	each([&](size_t place, int) { ++first[place + 1]; });
	for (size_t k = 1; k < first.size(); ++k)
		first[k] += first[k - 1];
	inCells.resize(first.back());
	std::vector<int> next(first.begin(), first.end() - 1);
	each([&](size_t place, int triangle) { inCells[next[place]++] = triangle; });
}

int TriangleField::column(double x) const { return std::clamp(int(std::floor((x - left) / cell)), 0, columns - 1); }
int TriangleField::row(double y) const { return std::clamp(int(std::floor((y - low) / cell)), 0, rows - 1); }

std::array<double, 3> TriangleField::shares(int triangle, double x, double y) const
{
	const auto &a = nodes[triangles[triangle][0]], &b = nodes[triangles[triangle][1]],
	           &c  = nodes[triangles[triangle][2]];
	const double s = twice[triangle];
	return { ((b.x - x) * (c.y - y) - (c.x - x) * (b.y - y)) / s,
		 ((c.x - x) * (a.y - y) - (a.x - x) * (c.y - y)) / s,
		 ((a.x - x) * (b.y - y) - (b.x - x) * (a.y - y)) / s };
}

int TriangleField::find(double x, double y) const
{
	if (triangles.empty() || !std::isfinite(x) || !std::isfinite(y)) return -1;
	const double margin = onEdge * cell;
	if (x < left - margin || x > left + columns * cell + margin || y < low - margin
	    || y > low + rows * cell + margin)
		return -1;
	const size_t place = size_t(row(y)) * columns + column(x);
	for (int k = first[place]; k < first[place + 1]; ++k) {
		const auto s = shares(inCells[k], x, y);
		if (s[0] >= -onEdge && s[1] >= -onEdge && s[2] >= -onEdge) return inCells[k];
	}
	return -1;
}

TriangleField::Value TriangleField::at(int triangle, double x, double y, const std::vector<double>& values) const
{
	const auto& [i, j, k] = triangles[triangle];
	const auto & a = nodes[i], &b = nodes[j], &c = nodes[k];
	const auto   s   = shares(triangle, x, y);
	const double toB = values[j] - values[i], toC = values[k] - values[i], area = twice[triangle];
	return { s[0] * values[i] + s[1] * values[j] + s[2] * values[k], (toB * (c.y - a.y) - toC * (b.y - a.y)) / area,
		 (toC * (b.x - a.x) - toB * (c.x - a.x)) / area };
}

} // namespace yade::nscd
