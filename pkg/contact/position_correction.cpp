#include <contact/extrapolation.hpp>
#include <contact/law.hpp>
#include <contact/sweeper.hpp>
#include <stdexcept>
#include <string>

namespace nonsmooth::contact {
namespace {

	/// Makes displacements of velocities: nothing has moved, and contacts ask for their errors along the normal alone.
	void takeErrors(Sweeper<double>& sweeper, std::size_t s, const std::vector<PositionError>& errors)
	{
		const ContactBlocks& laidOut = sweeper.laidOut;
		constexpr double     without = 1e100; // a bond holds whatever it costs
		for (std::size_t b = laidOut.blockBegin[s]; b < laidOut.blockBegin[s + 1]; ++b) {
			auto& k = sweeper.own.blocks[b];
			for (std::size_t l = 0; l < lanes; ++l)
				if (const auto index = laidOut.contactOf[b * lanes + l]; index != ContactBlocks::none) {
					k.biasN.v[l]    = errors[index].error;
					k.adhesion.v[l] = errors[index].held ? without : 0;
					k.n.v[l] = k.beforeN.v[l] = projectNormal(
					        errors[index].impulse, k.adhesion.v[l]);
				}
		}
		for (std::size_t k = laidOut.otherBegin[s]; k < laidOut.otherBegin[s + 1]; ++k) {
			const PositionError& e = errors[laidOut.others[k]];
			Contact&             c = sweeper.rows[k].contact;
			c.biasN                = e.error;
			c.adhesion             = e.held ? without : 0;
			c.biasT = c.biasR = c.friction = c.rollingArm = 0;
			sweeper.rows[k].p = sweeper.rows[k].before = { projectNormal(e.impulse, c.adhesion), 0, 0 };
		}
		sweeper.setOut(s);
	}

	void
	correct(Sweeper<double>& sweeper, const BlockKernels& kernels, const std::vector<PositionError>& errors,
	        int sweeps, PositionCorrection& result)
	{
		result.displacements.resize(sweeper.problem.bodyCount());
		result.impulses.resize(sweeper.problem.contactCount());
		Extrapolation       extrapolation(sweeper.settings.method);
		std::vector<double> betas(sweeps);
		for (double& b : betas)
			b = extrapolation.next();
		const auto visit = [&](std::size_t s, int pass, const StripSchedule::Ahead&) {
			Block<double>* const blocks = sweeper.blocksOf(s);
			const std::size_t    count  = sweeper.countOf(s);
			if (pass == 0) {
				takeErrors(sweeper, s, errors);
				kernels.applyNormals(blocks, count, sweeper.bodies.data());
				sweeper.applyRows(s);
			} else if (pass <= sweeps) {
				if (pass == 1) sweeper.keepBodies(s);
				sweeper.extrapolate(s, betas[pass - 1]);
				kernels.sweepNormals(blocks, count, sweeper.bodies.data(), betas[pass - 1]);
				sweeper.sweepRows(s, betas[pass - 1]);
			} else {
				sweeper.forImpulses(s, [&](std::int32_t index, const Impulse& p) {
					result.impulses[index] = p.n;
				});
				sweeper.forNew(s, [&](std::size_t place, std::int32_t b) {
					result.displacements[b] = sweeper.twistAt(place);
				});
			}
		};
#pragma omp parallel num_threads(sweeper.threads)
		{
			sweeper.plan();
			sweeper.forFixed([&](long place, std::int32_t b) {
				sweeper.setOut(place, b);
				result.displacements[b] = {};
			});
			sweeper.schedule.passes(omp_get_thread_num(), sweeps + 2, visit);
		}
	}

} // namespace

void correctPositions(
        Problem& problem, const SolverSettings& settings, Workspace& workspace,
        const std::vector<PositionError>& errors, int sweeps, PositionCorrection& result)
{
	const ContactBlocks& blocks = workspace.laidOut;
	if (errors.size() != problem.contactCount() || blocks.order.order.size() != problem.contactCount()
	    || blocks.placeOf.size() != problem.bodyCount())
		throw std::invalid_argument(
		        "correctPositions: " + std::to_string(errors.size()) + " errors for "
		        + std::to_string(problem.contactCount()) + " contacts, of which the last solve laid out "
		        + std::to_string(blocks.order.order.size()));
	Sweeper<double> sweeper(problem, settings, workspace);
	sweeper.fillRows();
	correct(sweeper, kernelsFor(settings), errors, sweeps, result);
}

} // namespace nonsmooth::contact
