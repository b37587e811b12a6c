// Which ends of walls meet, so that walls that were made one by one are one wall to a disk that rolls over their
// joints.
//
// Where nothing is known of the other, the end of a wall is a corner: a disk whose centre stands beyond it touches the
// end point. At a joint the end point lies on another wall, and would be a bump of the size of a step's path. With c
// the centre as seen from the end point, of the walls that meet there and act on the disk's side:
//   - one that passes through the point (a T) has the contact;
//   - one whose direction away from the point has a positive component along c has it, since the centre stands above its length;
//   - where the centre stands above none of them, in the wedge outside a convex corner, the first of them has it: that of lowest id, or of two the one that
//     Segment.nextDirection and previousDirection name (yade.nonsmooth.scene.join).
// So a joint has one contact where the walls go on straight or turn away from the disk, and two where they turn towards
// it.
//
// Ends meet where they are nearer than 1e-6 of the shorter wall's length, and rounding; where join() has named them, a
// hundredth. It is looked up by positions in the step in which walls have come, gone, moved or been changed, so it does
// not matter how or when they were made. Walls of different groupMask are not joined, nor what no disk can touch
// (Body.bounded False).
#pragma once

#include "../seam/PerScene.hpp"
#include <array>
#include <atomic>
#include <core/Scene.hpp>
#include <mutex>

namespace yade::nscd {

/// A wall's end: its point, the direction from there into the wall, and the side that counts as +.
struct WallTip {
	Vector3r point, along, up;
};

/// What meets the end of a wall.
struct WallEnd {
	struct Other {
		Vector3r along, up; // from the end point into the other; its + side there
		int      sense; // its side that acts, see Segment::sense
		bool     through; // it goes on at both sides of the point
		bool     first; // it has the point before this one
	};
	std::vector<Other> others;
	bool               isFirst = false; // of those that end here, another of which is there

	/// Whether the end point is this wall's to touch, for a disk whose centre stands at c beyond the end.
	bool owns(const Vector3r& c, Real radius) const
	{
		for (const Other& o : others) {
			const Real side = o.sense * o.up.dot(c); // negative behind a one-sided wall
			if (side < -radius) continue;
			if (o.through || (o.first && side >= 0)) return false;
			const Real ahead = c.dot(o.along);
			if (o.first ? ahead > 0 : ahead >= 0) return false;
		}
		return true;
	}
};

/// The two ends of a wall, that at its beginning first.
using WallEnds = std::array<WallEnd, 2>;

class WallJoints : public PerScene<WallJoints> {
public:
	/// Looks up which ends meet, where walls are other ones than at the last look or have moved; `ids`: all bodies
	/// that may be walls. Not while others ask.
	void find(const Scene& scene, const std::vector<int>& ids);
	/// What meets the ends of a wall in this step; `anew`: whatever was looked up before. For functors in YADE's
	/// loop, which nobody calls find() for.
	const WallEnds& endsOf(const Scene& scene, Body::id_t id, bool anew);

private:
	/// A wall as it was at the last look: all that its ends depend on.
	struct Wall {
		Body::id_t          id;
		const Shape*        shape;
		Vector3r            position;
		Quaternionr         orientation;
		Real                size, opening; // half length and 0; of an arc its radius and half of its angle
		int                 sense, mask;
		std::array<bool, 2> owns, yields; // by end, see join()

		bool                   operator==(const Wall& other) const;
		bool                   isArc() const { return opening > 0; }
		Real                   length() const { return 2 * size * (isArc() ? opening : 1); }
		std::array<WallTip, 2> tips() const;
		/// Whether a point lies on it, between its ends and up to a tolerance; `up`: its + side there.
		bool holds(const Vector3r& point, Real tolerance, Vector3r& up) const;
	};
	/// An end of another wall that meets one.
	struct Meeting {
		int wall, end;
	};
	void note(const Body* body);
	void meet();
	bool isBefore(int wall, int end, const Meeting& other, bool alone) const;

	std::mutex                          mutex;
	std::atomic<long>                   looked { std::numeric_limits<long>::min() }; // step, see stepOf
	std::vector<Wall>                   walls, now; // of the last look, and of this one
	std::vector<std::array<WallTip, 2>> tips; // by place in walls, as
	std::vector<WallEnds>               ends;
	std::vector<int>                    placeOf; // by id; −1 where there is no wall
};

} // namespace yade::nscd
