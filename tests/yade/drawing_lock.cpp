// Takes YADE's lock on the list of interactions, as its viewer does while it draws; test_engine.py holds the engine against it.
#include <core/InteractionContainer.hpp>
#include <core/Omega.hpp>
#include <core/Scene.hpp>

extern "C" {
void nonsmooth_begin_drawing() { yade::Omega::instance().getScene()->interactions->drawloopmutex.lock(); }
void nonsmooth_end_drawing() { yade::Omega::instance().getScene()->interactions->drawloopmutex.unlock(); }
}
