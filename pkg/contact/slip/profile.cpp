#include "profile.hpp"
#include <algorithm>
#include <cmath>

namespace nonsmooth::contact::slip {

double Nodes::place(std::size_t node) const
{
	double y = 0;
	for (std::size_t k = 0; k < node; ++k)
		y += width[k];
	return y + 0.5 * width[node];
}

double Nodes::mean(const double* profile) const
{
	double sum = 0, length = 0;
	for (std::size_t k = 0; k < inside; ++k) {
		sum += width[k] * profile[k];
		length += width[k];
	}
	return sum / length;
}

Nodes nodesOf(const NodeSizes& sizes)
{
	Nodes        nodes;
	const double half = 0.5 * sizes.thickness;
	if (sizes.reach == 0 && half > 0) // nothing leaves the zone, which is the same all through
		nodes.width = { half };
	else if (half == 0)
		nodes.width = { sizes.finest };
	else {
		double length = 0;
		for (double w = std::min(sizes.finest, half); length < half; w *= sizes.growth) {
			nodes.width.push_back(w);
			length += w;
		}
		for (double& w : nodes.width)
			w *= half / length;
		std::reverse(nodes.width.begin(), nodes.width.end());
	}
	nodes.inside  = nodes.width.size();
	double beyond = 0;
	for (double w = half == 0 ? sizes.growth * sizes.finest : nodes.width.back(); beyond < sizes.reach;
	     w *= sizes.growth) {
		nodes.width.push_back(w);
		beyond += w;
	}
	return nodes;
}

void Diffusion::prepare(const Nodes& nodes, double diffusivity, double h)
{
	const std::size_t   n = nodes.count();
	std::vector<double> flow(n + 1, 0); // α h over the distance of two nodes' middles
	for (std::size_t k = 1; k < n; ++k)
		flow[k] = diffusivity * h / (0.5 * (nodes.width[k - 1] + nodes.width[k]));
	lower.assign(n, 0);
	ratio.assign(n, 0);
	inverse.assign(n, 0);
	for (std::size_t k = 0; k < n; ++k) {
		const double below = flow[k] / nodes.width[k], above = flow[k + 1] / nodes.width[k];
		lower[k]   = below;
		inverse[k] = 1 / (1 + below + above - (k ? below * ratio[k - 1] : 0));
		ratio[k]   = above * inverse[k];
	}
}

void Diffusion::apply(const double* u, double* after) const
{
	const std::size_t n = inverse.size();
	after[0]            = u[0] * inverse[0];
	for (std::size_t k = 1; k < n; ++k)
		after[k] = (u[k] + lower[k] * after[k - 1]) * inverse[k];
	for (std::size_t k = n - 1; k-- > 0;)
		after[k] += ratio[k] * after[k + 1];
}

} // namespace nonsmooth::contact::slip
