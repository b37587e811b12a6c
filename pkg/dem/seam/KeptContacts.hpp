// Contacts in arrays of their own beside those of Resident (space/SpaceContacts.hpp), which are shown with them.
#pragma once

#include "LookClock.hpp"

namespace yade::nscd {

class KeptContacts {
public:
	virtual ~KeptContacts() = default;
	/// Whether the arrays are right and not the interactions.
	bool owned() const { return areOwned; }
	/// Writes all into the interactions, which own it from now on. What somebody else has written into a contact's
	/// physics meanwhile stays, and is taken up when they are taken again.
	virtual void show() = 0;
	/// Makes sure that what they point to stays, whatever other threads erase.
	virtual void hold() = 0;
	/// Leaves the arrays right while a script goes on, which may end contacts: the next step looks which are there.
	virtual void leaveAlone() = 0;
	/// Whether it is time for a look by others who may look at any time, see LookClock.
	bool isDue(bool wanted) const { return looks.isDue(wanted); }

protected:
	bool      areOwned = false;
	LookClock looks;
};

} // namespace yade::nscd
