// Contact of a disk with a wall whose friction a slip law finds in cells along it, see SlipSurfaceMat.
#pragma once

#include "NscdPhys.hpp"
#include "SlipSurfaceMat.hpp"

namespace yade {

class SlipSurfacePhys : public NscdPhys {
public:
	virtual ~SlipSurfacePhys() { nscd::letGo(wallMaterial); }
	void updateThresholds(Real gap, Real adhesionRange) override;
	void noteSliding(const nscd::Sliding& sliding) override;
	bool countsSlip() const override { return true; }
	// clang-format off
	YADE_CLASS_BASE_DOC_ATTRS_CTOR(SlipSurfacePhys,NscdPhys,
R"""(Contact of a disk with a wall of :yref:`SlipSurfaceMat`: its friction is that of the cell of the wall in which it was in the step before.)""",
		((shared_ptr<SlipSurfaceMat>,wallMaterial,,Attr::readonly,"The wall's material, which has the cells."))
		((Body::id_t,wall,-1,Attr::readonly,"The wall."))
		((int,cell,-1,Attr::readonly,"The cell; −1 before the contact's first step."))
		,
		createIndex();
	);
	// clang-format on
	REGISTER_CLASS_INDEX(SlipSurfacePhys, NscdPhys);
};
REGISTER_SERIALIZABLE(SlipSurfacePhys);

} // namespace yade
