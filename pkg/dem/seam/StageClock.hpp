// Wall time of the stages of a step: one clock, which the plugin's engines write to and the scene's
// ContactDynamicsEngine keeps.
#pragma once

#include <array>
#include <chrono>
#include <core/Scene.hpp>

namespace yade::nscd {

/// By a clock that nobody sets [s].
inline double steadySeconds()
{
	return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// In the order of a step.
enum class Stage { Collide, Interactions, Gather, Solve, Correct, Scatter, Integrate };

struct StageClock {
	static constexpr std::array<const char*, 7> names { "collide", "interactions", "gather",   "solve",
		                                            "correct", "scatter",      "integrate" };

	std::array<Real, names.size()> seconds {}; // by stage, so far

	/// That of the scene's ContactDynamicsEngine; null where none runs, and nobody would read it.
	static StageClock* of(const Scene& scene);
};

/// Counts the time from one state of the clock to the next for the stage that goes on in between; the last stage ends
/// with the block, however it ends.
class StageTimer {
public:
	StageTimer(StageClock* clock, Stage first)
	        : clock(clock)
	        , stage(first)
	        , begin(Steady::now())
	{
	}
	~StageTimer() { count(Steady::now()); }
	StageTimer(const StageTimer&)            = delete;
	StageTimer& operator=(const StageTimer&) = delete;

	/// Ends a stage and begins another.
	void next(Stage following)
	{
		const auto now = Steady::now();
		count(now);
		stage = following;
		begin = now;
	}

private:
	using Steady = std::chrono::steady_clock;

	void count(Steady::time_point end)
	{
		if (clock) clock->seconds[size_t(stage)] += std::chrono::duration<Real>(end - begin).count();
	}

	StageClock*        clock;
	Stage              stage;
	Steady::time_point begin;
};

} // namespace yade::nscd
