#include <algorithm>
#include <cmath>
#include <contact/plane/bordered_band.hpp>

namespace nonsmooth::contact {
namespace {

	/// Whether it can be divided by.
	bool usable(double pivot) { return pivot != 0 && std::isfinite(pivot); }

} // namespace

void BorderedBand::reset(std::size_t inner_, std::size_t border_, std::size_t width_)
{
	inner  = inner_;
	border = border_;
	width  = width_;
	stride = 3 * width + 1;
	band.assign(inner * stride, 0);
	right.assign(inner * border, 0);
	below.assign(border * inner, 0);
	corner.assign(border * border, 0);
	pivot.resize(inner);
	cornerPivot.resize(border);
}

double& BorderedBand::at(std::size_t row, std::size_t column)
{
	if (row < inner)
		return column < inner ? rowOf(row)[column + width - row] : right[row * border + column - inner];
	row -= inner;
	return column < inner ? below[row * inner + column] : corner[row * border + column - inner];
}

bool BorderedBand::factorise()
{
	for (std::size_t k = 0; k < inner; ++k) {
		const std::size_t last = std::min(inner, k + width + 1), end = std::min(inner, k + 2 * width + 1);
		std::size_t       best = k;
		for (std::size_t r = k + 1; r < last; ++r)
			if (std::abs(rowOf(r)[k + width - r]) > std::abs(rowOf(best)[k + width - best])) best = r;
		pivot[k] = best;
		if (best != k)
			std::swap_ranges(
			        rowOf(k) + width, rowOf(k) + width + (end - k), rowOf(best) + k + width - best);
		const double* const top = rowOf(k) + width;
		if (!usable(top[0])) return false;
		for (std::size_t r = k + 1; r < last; ++r) {
			double* const row    = rowOf(r) + k + width - r;
			const double  factor = row[0] / top[0];
			row[0]               = factor;
			if (factor == 0) continue;
			for (std::size_t c = 1; c < end - k; ++c)
				row[c] -= factor * top[c];
		}
	}
	solveInner(right.data(), border); // B⁻¹ C
	for (std::size_t r = 0; r < border; ++r)
		for (std::size_t k = 0; k < inner; ++k) {
			const double factor = below[r * inner + k];
			if (factor == 0) continue;
			for (std::size_t c = 0; c < border; ++c)
				corner[r * border + c] -= factor * right[k * border + c];
		}
	return factoriseCorner();
}

bool BorderedBand::factoriseCorner()
{
	double* const e = corner.data();
	for (std::size_t k = 0; k < border; ++k) {
		std::size_t best = k;
		for (std::size_t r = k + 1; r < border; ++r)
			if (std::abs(e[r * border + k]) > std::abs(e[best * border + k])) best = r;
		cornerPivot[k] = best;
		if (best != k) std::swap_ranges(e + k * border, e + (k + 1) * border, e + best * border);
		if (!usable(e[k * border + k])) return false;
		for (std::size_t r = k + 1; r < border; ++r) {
			const double factor = e[r * border + k] /= e[k * border + k];
			for (std::size_t c = k + 1; c < border; ++c)
				e[r * border + c] -= factor * e[k * border + c];
		}
	}
	return true;
}

/// B⁻¹ for so many columns that lie side by side.
void BorderedBand::solveInner(double* x, std::size_t columns) const
{
	const auto take = [&](std::size_t row, std::size_t from, double factor) {
		for (std::size_t c = 0; c < columns; ++c)
			x[row * columns + c] -= factor * x[from * columns + c];
	};
	for (std::size_t k = 0; k < inner; ++k) {
		if (pivot[k] != k) std::swap_ranges(x + k * columns, x + (k + 1) * columns, x + pivot[k] * columns);
		for (std::size_t r = k + 1; r < std::min(inner, k + width + 1); ++r)
			take(r, k, rowOf(r)[k + width - r]);
	}
	for (std::size_t k = inner; k-- > 0;) {
		const double* const row = rowOf(k) + width;
		for (std::size_t c = k + 1; c < std::min(inner, k + 2 * width + 1); ++c)
			take(k, c, row[c - k]);
		for (std::size_t c = 0; c < columns; ++c)
			x[k * columns + c] /= row[0];
	}
}

void BorderedBand::solve(std::vector<double>& x) const
{
	solveInner(x.data(), 1);
	double* const last = x.data() + inner;
	for (std::size_t r = 0; r < border; ++r)
		for (std::size_t k = 0; k < inner; ++k)
			last[r] -= below[r * inner + k] * x[k];
	for (std::size_t k = 0; k < border; ++k)
		std::swap(last[k], last[cornerPivot[k]]);
	for (std::size_t k = 0; k < border; ++k)
		for (std::size_t r = k + 1; r < border; ++r)
			last[r] -= corner[r * border + k] * last[k];
	for (std::size_t k = border; k-- > 0;) {
		for (std::size_t c = k + 1; c < border; ++c)
			last[k] -= corner[k * border + c] * last[c];
		last[k] /= corner[k * border + k];
	}
	for (std::size_t k = 0; k < inner; ++k)
		for (std::size_t c = 0; c < border; ++c)
			x[k] -= right[k * border + c] * last[c];
}

} // namespace nonsmooth::contact
