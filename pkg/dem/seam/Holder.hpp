// Keeps an interaction and its objects, whatever other threads erase.
#pragma once

#include "PythonMade.hpp"
#include <core/Interaction.hpp>

namespace yade::nscd {

struct Holder {
	shared_ptr<Interaction> interaction;
	shared_ptr<IGeom>       geom;
	shared_ptr<IPhys>       phys;

	static Holder of(Interaction& i)
	{
		return { boost::static_pointer_cast<Interaction>(i.shared_from_this()), i.geom, i.phys };
	}

	void letGo()
	{
		nscd::letGo(geom);
		nscd::letGo(phys);
		if (interaction
		    && interaction.use_count() == 1) { // it ends here, with what a script has put into it since
			nscd::letGo(interaction->geom);
			nscd::letGo(interaction->phys);
		}
		nscd::letGo(interaction);
	}
};

} // namespace yade::nscd
