// A system of linear equations whose matrix is a band with a border: A = [B C; D E], B of `inner` unknowns with few
// diagonals, E of the last few.
//
// B is factorised by Gaussian elimination with partial pivoting inside the band (Golub and Van Loan, Matrix
// Computations, section 4.3), E after it as the Schur complement E − D B⁻¹ C. The order of all operations is fixed.
#pragma once

#include <cstddef>
#include <vector>

namespace nonsmooth::contact {

class BorderedBand {
public:
	/// All numbers 0. `width`: how far a number of B may lie from the diagonal.
	void reset(std::size_t inner, std::size_t border, std::size_t width);
	/// The number in a row and a column, both counted over B and E; inside the band or the border.
	double& at(std::size_t row, std::size_t column);
	/// Returns false where a pivot is 0 or no number.
	bool factorise();
	/// x becomes A⁻¹ x; after factorise().
	void solve(std::vector<double>& x) const;

	/// Multiplications that factorise() makes, nearly.
	static double work(std::size_t inner, std::size_t border, std::size_t width)
	{
		const double n = double(inner), w = double(width), e = double(border);
		return n * w * (2 * w + 1) + n * e * (3 * w + 2 * e) + e * e * e;
	}

private:
	double*       rowOf(std::size_t row) { return band.data() + row * stride; }
	const double* rowOf(std::size_t row) const { return band.data() + row * stride; }
	void          solveInner(double* x, std::size_t columns) const;
	bool          factoriseCorner();

	std::size_t              inner = 0, border = 0, width = 0, stride = 0;
	std::vector<double>      band; // of row r the columns r − width … r + 2 width, which pivots fill
	std::vector<double>      right, below, corner; // C, of row r all columns; D and E
	std::vector<std::size_t> pivot, cornerPivot;
};

} // namespace nonsmooth::contact
