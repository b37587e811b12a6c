#include "EngineRoles.hpp"
#include <typeindex>
#include <unordered_map>
#include <utility>

namespace yade::nscd {

namespace {
	using Told = std::pair<EngineRole, ActsIn>;

	/// Filled while the library is loaded, and only read afterwards.
	std::unordered_map<std::type_index, Told>& roles()
	{
		static std::unordered_map<std::type_index, Told> all;
		return all;
	}

	Told toldOf(const Engine& engine)
	{
		const auto found = roles().find(typeid(engine));
		return found == roles().end() ? Told { EngineRole::Stranger, nullptr } : found->second;
	}
}

bool giveRole(const std::type_info& engineClass, EngineRole role, ActsIn acts)
{
	return roles().emplace(engineClass, Told { role, acts }).second;
}

EngineRole roleOf(const Engine& engine) { return toldOf(engine).first; }

ActsIn actsOf(const Engine& engine) { return toldOf(engine).second; }

} // namespace yade::nscd
