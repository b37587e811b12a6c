// Passes over blocks in space that are made once a solve, and are the same code on every processor: numbers in, rounded
// to floats, and impulses back.
#pragma once

#include <contact/space/block.hpp>

namespace nonsmooth::contact::space {

/// BlockKernelsIn::fill, round and take.
void fillBlocks(
        Block<double>* blocks, Numbers<double>* inverseLength, const std::int32_t* contactOf, std::size_t count,
        const BlockNumbers& from);
void roundBlocks(
        const Block<double>* from, const Numbers<double>* inverseLength, std::size_t count, Block<float>* to,
        Numbers<float>* inverseLengthTo);
void takeImpulses(const Block<float>* from, std::size_t count, Block<double>* to);

} // namespace nonsmooth::contact::space
