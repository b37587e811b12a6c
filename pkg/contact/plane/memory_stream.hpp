// How fast one thread reads, changes and writes back memory: the bound that a sweep over blocks is held against.
#pragma once

#include <contact/plane/block_kernels.hpp>
#include <vector>

namespace nonsmooth::contact {

class MemoryStream {
public:
	/// Takes the memory, and touches it so that the first pass finds it there; a part of a Motion is left out.
	explicit MemoryStream(std::size_t bytes)
	        : numbers(bytes / sizeof(Motion<double>))
	{
	}
	/// Reads, changes and writes every number once, in the order of memory.
	void        pass();
	std::size_t bytes() const { return numbers.size() * sizeof(Motion<double>); }

private:
	std::vector<Motion<double>> numbers;
};

} // namespace nonsmooth::contact
