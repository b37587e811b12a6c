// A plate that a given force or stress presses: the servo of laboratory tests, as a body.
//
// The plate moves along one direction d by Newton's law, contacts and load together in each step:
//     m dv/dt = F + σ w (n·d) − c v + contacts ,
// with F a force, σ a stress on the plate's width w, n the plate's normal, c a damping. So the load is borne exactly at
// rest and nothing swings, as it does where the plate's velocity is set
// from the force of the step before. The damping is c v/(1 + c h/m), of the speed at the step's beginning: stable for
// any c, and nothing at rest; a free plate comes to F/c + h F/m.
// The width follows the plate or the walls between which it stands: with p a point of the plate, a its direction, q and
// b those of a wall, the wall's line meets the
// plate's at s = (q − p) × b / (a × b), and w = |s₂ − s₁|, but no more than the plate's length.
// Along an axis YADE's blockedDOFs hold the plate in its way. At other angles a guide does: a contact without friction,
// which also pulls, between the plate and a rail that stays where it is;
// with soft contacts the engine takes the force across the way off. Forces are per metre of thickness.
#pragma once

#include <core/GlobalEngine.hpp>
#include <core/Interaction.hpp>

namespace yade {

namespace nscd {
	class Resident;
}

class PlateLoadEngine : public GlobalEngine {
public:
	void action() override;
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS(PlateLoadEngine,GlobalEngine,
R"""(Loads a plate, a body with a mass that is free along one direction, by a force or a stress that follows its width; see :yref:`yade.nonsmooth.scene.plate`, which makes plate and engine in one call.
Place it after :yref:`ForceResetter` and before :yref:`ContactDynamicsEngine`, in soft scenes after :yref:`InteractionLoop` and right before the integrator.)""",
		((Body::id_t,id,-1,,"The plate."))
		((Vector3r,direction,Vector3r(0,-1,0),,"Unit vector in the x-y plane along which the load pushes and the plate is free."))
		((Real,force,0,,"Force along it [N]."))
		((Real,stress,0,,"Normal stress on the plate [Pa], positive towards its side of "
		        ":yref:`direction<PlateLoadEngine.direction>`; its part along the direction acts, on the present "
		        "width."))
		((vector<int>,between,,,"Two bodies between which the plate is loaded, as the side walls of a box; none: the plate's own length is its width."))
		((Real,damping,0,,"Force against the plate's velocity [N s/m]."))
		((bool,weightless,true,,"The plate's weight is taken off, so that it presses with the load alone; its mass says how it moves."))
		((Body::id_t,rail,-1,,"A body that stays where it is and holds the guide of a plate that moves neither along x nor along y."))
		((Vector3r,origin,Vector3r::Zero(),,"A point of the way of a plate with a rail [m]."))
		((Real,width,0,(Attr::readonly|Attr::noSave),"Present width that the stress acts on [m]."))
		((Real,load,0,(Attr::readonly|Attr::noSave),"Force along the direction that was put on it in the last step, without damping and weight [N]."))
	);
	// clang-format on

private:
	void         validate() const;
	Real         presentWidth(const nscd::Resident& resident, const Vector3r& way) const;
	Interaction* guide();
	void         dropFormerGuide(nscd::Resident& resident);
	void         hold(nscd::Resident& resident, const Vector3r& way);

	Body::id_t guidedBy = -2; // the rail of the last step; −2: not known
};
REGISTER_SERIALIZABLE(PlateLoadEngine);

} // namespace yade
