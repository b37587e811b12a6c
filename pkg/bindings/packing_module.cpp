// Packing for Python, as _nonsmooth_packing: arrays in, arrays out. No YADE here; nonsmooth/packing is the face of it.
//
// Disks are arrays x, y, r of one length [m]; edges of a region a tuple (start (n, 2), direction (n, 2), length,
// convex_start, convex_end), see nonsmooth.model.geometry.Edges. `threads` are as many as OpenMP has, by its
// environment or as the host program has set them, where they are 0.
#include <bindings/arrays.hpp>
#include <omp.h>
#include <packing/close_pairs.hpp>
#include <packing/relaxation.hpp>

using namespace nonsmooth::packing;
using namespace nonsmooth::bindings;

namespace {

using Flags = py::array_t<bool, py::array::c_style | py::array::forcecast>;
using Longs = py::array_t<std::int64_t>;

/// Sweeps of fewer disks are so short that on a busy machine threads would mostly wait for each other.
constexpr py::ssize_t disksOfThread = 20000;

int threadsOf(int wanted, py::ssize_t disks)
{
	return wanted > 0 ? wanted : int(std::clamp<py::ssize_t>(disks / disksOfThread, 1, omp_get_max_threads()));
}

/// Three lists of one length.
void check(const Doubles& x, const Doubles& y, const Doubles& r)
{
	for (const Doubles* a : { &x, &y, &r })
		if (a->ndim() != 1 || a->size() != x.size())
			throw py::value_error("x, y and r must be lists of one length");
}

template <class Array> auto listOf(const Array& a)
{
	if (a.ndim() != 1) throw py::value_error("expected a list");
	return std::vector<typename Array::value_type>(a.data(), a.data() + a.size());
}

std::vector<Edge> edgesOf(const py::tuple& given)
{
	if (given.size() != 5)
		throw py::value_error("edges are a tuple (start, direction, length, convex_start, convex_end)");
	const auto start = py::cast<Doubles>(given[0]), direction = py::cast<Doubles>(given[1]),
	           length      = py::cast<Doubles>(given[2]);
	const auto convexStart = py::cast<Flags>(given[3]), convexEnd = py::cast<Flags>(given[4]);
	const auto count = length.size();
	for (const Doubles* a : { &start, &direction })
		if (a->ndim() != 2 || a->shape(0) != count || a->shape(1) != 2)
			throw py::value_error("start and direction of edges must have the shape (n, 2)");
	if (length.ndim() != 1 || convexStart.ndim() != 1 || convexEnd.ndim() != 1 || convexStart.size() != count
	    || convexEnd.size() != count)
		throw py::value_error("length, convex_start and convex_end of edges must be lists of one length");
	std::vector<Edge> edges;
	for (py::ssize_t k = 0; k < count; ++k)
		edges.push_back({ start.at(k, 0), start.at(k, 1), direction.at(k, 0), direction.at(k, 1), length.at(k),
		                  convexStart.at(k), convexEnd.at(k) });
	return edges;
}

/// Of pairs (edges, acts), with acts None or a flag for each of `count` disks.
std::vector<Border> bordersOf(const py::list& given, std::size_t count)
{
	std::vector<Border> borders;
	for (const py::handle one : given) {
		const auto [edges, acts] = py::cast<std::pair<py::tuple, py::object>>(one);
		Border border { edgesOf(edges), {} };
		if (!acts.is_none()) {
			const auto flags = py::cast<Flags>(acts);
			if (flags.ndim() != 1 || std::size_t(flags.size()) != count)
				throw py::value_error("a border must say of each disk whether it acts on it");
			border.acts.assign(flags.data(), flags.data() + flags.size());
		}
		borders.push_back(std::move(border));
	}
	return borders;
}

py::tuple closePairsOf(const Doubles& x, const Doubles& y, const Doubles& r, double margin, int threads)
{
	check(x, y, r);
	std::vector<nonsmooth::neighbours::Disk> disks;
	for (py::ssize_t k = 0; k < x.size(); ++k)
		disks.push_back({ x.at(k), y.at(k), r.at(k) });
	std::vector<int> first, second;
	closePairs(disks, margin, threadsOf(threads, x.size()), first, second);
	const auto size = py::ssize_t(first.size());
	Longs      i(size), j(size);
	std::copy(first.begin(), first.end(), i.mutable_data());
	std::copy(second.begin(), second.end(), j.mutable_data());
	return py::make_tuple(i, j);
}

/// Pairs (disk, edge) with a gap below the margin, by disk and then by edge: both numbers, overlap, and its direction
/// into the region.
py::tuple pushesOf(const Doubles& x, const Doubles& y, const Doubles& r, double margin, const py::tuple& given)
{
	check(x, y, r);
	const auto                edges = edgesOf(given);
	std::vector<std::int64_t> disks, walls;
	std::vector<double>       overlap, nx, ny;
	for (py::ssize_t k = 0; k < x.size(); ++k)
		for (std::size_t e = 0; e < edges.size(); ++e) {
			if (!isNear(edges[e], x.at(k), y.at(k), r.at(k), margin)) continue;
			const Push p = pushOf(edges[e], x.at(k), y.at(k), r.at(k));
			disks.push_back(k);
			walls.push_back(std::int64_t(e));
			overlap.push_back(p.overlap);
			nx.push_back(p.x);
			ny.push_back(p.y);
		}
	const auto array = [](const auto& list) { return py::array(py::ssize_t(list.size()), list.data()); };
	return py::make_tuple(array(disks), array(walls), array(overlap), array(nx), array(ny));
}

/// The disks, checked, as the relaxation wants them.
Given givenOf(const Doubles& x, const Doubles& y, const Doubles& r, const Ints& layer, const Ints& bySize)
{
	check(x, y, r);
	if (x.size() == 0) throw py::value_error("there is no disk");
	Given             given { listOf(x), listOf(y), listOf(r), listOf(layer), listOf(bySize) };
	const std::size_t count = given.x.size();
	for (std::size_t k = 0; k < count; ++k)
		if (!(given.r[k] > 0) || !std::isfinite(given.x[k] + given.y[k] + given.r[k]))
			throw py::value_error("places must be finite, and radii above 0");
	std::vector<int> sorted = given.bySize;
	std::sort(sorted.begin(), sorted.end());
	bool isOrder = given.layer.size() == count && sorted.size() == count;
	for (std::size_t k = 0; isOrder && k < count; ++k)
		isOrder = sorted[k] == int(k);
	if (!isOrder) throw py::value_error("layer and order must have as many entries as disks, the order each disk");
	return given;
}

} // namespace

PYBIND11_MODULE(_nonsmooth_packing, m)
{
	m.doc() = "Packing of disks; use nonsmooth.packing.";
	m.def("close_pairs", &closePairsOf, py::arg("x"), py::arg("y"), py::arg("r"), py::arg("margin"),
	      py::arg("threads") = 0);
	m.def("pushes", &pushesOf, py::arg("x"), py::arg("y"), py::arg("r"), py::arg("margin"), py::arg("edges"));
	m.def("numpy_sum", [](const Doubles& values) { return numpySum(values.data(), std::size_t(values.size())); });
	m.attr("compiler") = NONSMOOTH_COMPILER;

	const auto column = [](Relaxation::Column which) {
		return [which](const Relaxation& own) {
			const auto values = own.column(which);
			return py::array(py::ssize_t(values.size()), values.data());
		};
	};
	using Column = Relaxation::Column;
	py::class_<Relaxation>(m, "Relaxation")
	        .def(py::init([](const Doubles& x, const Doubles& y, const Doubles& r, const Ints& layer,
	                         const Ints& bySize, const py::list& borders, int threads) {
		             return Relaxation(
		                     givenOf(x, y, r, layer, bySize), bordersOf(borders, std::size_t(x.size())),
		                     threadsOf(threads, x.size()));
	             }),
	             py::arg("x"), py::arg("y"), py::arg("r"), py::arg("layer"), py::arg("order"), py::arg("borders"),
	             py::arg("threads") = 0)
	        .def("forces", &Relaxation::forces, py::arg("squeezes"))
	        .def("exchange", &Relaxation::exchange, py::arg("first"), py::arg("stride"))
	        .def("step", &Relaxation::step)
	        .def("__len__", &Relaxation::count)
	        .def_property_readonly("x", column(Column::x))
	        .def_property_readonly("y", column(Column::y))
	        .def_property_readonly("r", column(Column::r))
	        .def_property_readonly("force_x", column(Column::forceX))
	        .def_property_readonly("force_y", column(Column::forceY))
	        .def_property_readonly("squeeze", column(Column::squeeze));
}
