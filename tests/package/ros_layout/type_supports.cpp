// rosidl's introspection of every message, as one translation unit. Handles are declared first,
// since a message may come before the ones that it holds.
#include <rosidl_typesupport_introspection_cpp/message_type_support_decl.hpp>

#include "structs.inc"

namespace rosidl_typesupport_introspection_cpp {
#define BEGIN(package, folder, name) \
    template <>                      \
    const rosidl_message_type_support_t* get_message_type_support_handle<package::folder::name>();
#define MEMBER(name)
#define END
#include "types.inc"
#undef BEGIN
#undef MEMBER
#undef END
}  // namespace rosidl_typesupport_introspection_cpp

#include "type_supports.inc"
