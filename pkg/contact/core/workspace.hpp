// What one solve leaves to the next.
#pragma once

#include <contact/core/contact_blocks.hpp>
#include <type_traits>

namespace nonsmooth::contact {

template <class Dimension, class Number> struct BodiesIn {
	std::vector<typename Dimension::template Motion<Number>> now, before; // by place; the last one is nobody
};

/// Memory that one solve leaves to the next, and the layout in it, which is kept where it fits; what it holds changes
/// no bit.
template <class Dimension> struct WorkspaceIn {
	ContactBlocksIn<Dimension>  laidOut;
	BodiesIn<Dimension, double> inDouble;
	BodiesIn<Dimension, float>  inSingle;

	template <class Number> BodiesIn<Dimension, Number>& with()
	{
		if constexpr (std::is_same_v<Number, double>) return inDouble;
		else
			return inSingle;
	}
};

} // namespace nonsmooth::contact
