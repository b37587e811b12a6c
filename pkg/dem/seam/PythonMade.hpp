// Objects that Python has made, and that end where Python's lock is not held: in advance(), and in the thread of
// O.run().
//
// Boost.Python gives such an object a deleter that takes a reference off, which without the lock ends the process.
// Whoever may be the last to hold one lets it go here; it ends the next time that one of our engines has its turn in a
// thread that has the lock, or when advance() returns.
#pragma once

#include <boost/python.hpp>
#include <boost/shared_ptr.hpp>

namespace yade::nscd {

/// Keeps it until endKept().
void keepUntilLocked(boost::shared_ptr<const void> object);
/// Ends what is kept, where this thread has Python's lock; else nothing.
void endKept();

/// Lets an object go, whoever holds Python's lock.
template <class Object> void letGo(boost::shared_ptr<Object>& object)
{
	if (object && boost::get_deleter<boost::python::converter::shared_ptr_deleter>(object)) keepUntilLocked(object);
	object.reset();
}

} // namespace yade::nscd
