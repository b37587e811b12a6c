// What one thread reads, changes and writes back a second, each byte counted once: over as many bytes as the problem's blocks take, which
// may fit into a cache, and over 256 MB, which do not.
#include "problem.hpp"
#include <benchmark/benchmark.h>
#include <contact/plane/memory_stream.hpp>

using namespace nonsmooth::contact;

namespace {

void stream(benchmark::State& state, std::size_t bytes)
{
	MemoryStream memory(bytes);
	memory.pass();
	for (auto _ : state) {
		memory.pass();
		benchmark::ClobberMemory();
	}
	state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * memory.bytes()));
	state.counters["megabytes"] = 1e-6 * static_cast<double>(memory.bytes());
}

void blocks(benchmark::State& state)
{
	try {
		stream(state, benchmarks::problem().contactCount() * sizeof(Block<float>) / lanes);
	} catch (const std::exception& error) {
		state.SkipWithError(error.what());
	}
}

void memory(benchmark::State& state) { stream(state, 256'000'000); }

BENCHMARK(blocks);
BENCHMARK(memory)->Unit(benchmark::kMillisecond);

} // namespace
