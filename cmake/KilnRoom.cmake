# SPDX-License-Identifier: Apache-2.0
# A room is include/kiln/<room> + src/<room> + the target kiln::<room>.
#
#   kiln_room(bake FLOOR 6 USES material light ... SOURCES a.cpp b.cpp [LIBRARIES x] [PUBLIC_LIBRARIES y])
#
# USES is the one place that says which rooms a room may include; tests/house reads it back.
# LIBRARIES are third-party and private to the room; PUBLIC_LIBRARIES show in its headers.
function(kiln_room name)
  cmake_parse_arguments(ROOM "" "FLOOR" "USES;SOURCES;LIBRARIES;PUBLIC_LIBRARIES" ${ARGN})
  if(ROOM_SOURCES)
    add_library(kiln_${name} STATIC ${ROOM_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(kiln_${name} PRIVATE ${ROOM_LIBRARIES})
  else()
    add_library(kiln_${name} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(kiln::${name} ALIAS kiln_${name})
  target_include_directories(kiln_${name} ${scope} "${PROJECT_SOURCE_DIR}/include")
  target_link_libraries(kiln_${name} ${scope} kiln_flags ${ROOM_PUBLIC_LIBRARIES})
  foreach(used IN LISTS ROOM_USES)
    target_link_libraries(kiln_${name} ${scope} kiln::${used})
  endforeach()
  list(JOIN ROOM_USES " " uses)
  set_property(GLOBAL APPEND_STRING PROPERTY KILN_FLOOR_PLAN "${ROOM_FLOOR} ${name}: ${uses}\n")
endfunction()

# The floor plan as text, one line a room: "<floor> <room>: <rooms it may include>".
function(kiln_write_floor_plan file)
  get_property(plan GLOBAL PROPERTY KILN_FLOOR_PLAN)
  file(WRITE "${file}" "${plan}")
endfunction()
