#include "law.hpp"
#include <stdexcept>

namespace nonsmooth::contact::slip {

void Law::prepare(double h)
{
	if (!(h > 0)) throw std::invalid_argument("h = " + std::to_string(h) + " s: a step's length must be positive");
	step = h;
}

void Law::advance(Cells& cells, Range range) const
{
	for (std::size_t k = range.begin; k < range.end; ++k)
		cells.slip[k] += cells.path[k];
}

double Law::friction()
{
	if (!(step > 0)) prepare(1); // at rest the step's length does not matter
	constexpr double stress = 1e6;
	Cells            one    = cells(1, stress);
	strength(one, one.all());
	return one.strength[0] / stress;
}

Cells Law::cells(std::size_t count, double normalStress) const
{
	Cells made;
	made.normalStress.assign(count, normalStress);
	for (auto* column : { &made.slipRate, &made.strength, &made.path, &made.heat, &made.slip })
		column->assign(count, 0);
	for (const StateColumn& column : columns())
		made.stateWidth = column.offset + column.width;
	made.betweenWidth = betweenWidth();
	made.state.assign(count * made.stateWidth, 0);
	made.between.assign(count * made.betweenWidth, 0);
	for (std::size_t k = 0; k < count; ++k)
		begin(made.stateOf(k));
	return made;
}

} // namespace nonsmooth::contact::slip
