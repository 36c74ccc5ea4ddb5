# Sources that are compiled together. Most of the time of a test or of a text of the program goes into headers (Eigen, GoogleTest,
# CLI11), which a group of sources reads once.
option(TANKTREAD_UNITE "Compile tests and texts in groups; OFF: each source by itself, which is quicker while one is worked on" ON)
set(TANKTREAD_UNITED_FOLDER ${PROJECT_BINARY_DIR}/united CACHE PATH
  "Where the groups are written: the same for several build folders of one checkout lets ccache know them again")

# tanktread_unite(RESULT NAME SIZE SOURCES ...): sets RESULT to sources NAME_1.cpp, NAME_2.cpp ..., which include up to SIZE of the given ones each.
# A source with definitions of its own stays by itself. What computes numbers needs tanktread_round_each_operation().
function(tanktread_unite result name size)
  set(${result} ${ARGN} PARENT_SCOPE)
  if(NOT TANKTREAD_UNITE)
    return()
  endif()
  set(sources)
  set(alone)
  foreach(source IN LISTS ARGN)
    get_source_file_property(definitions ${source} COMPILE_DEFINITIONS)
    if(definitions)
      list(APPEND alone ${source})
    else()
      list(APPEND sources ${source})
    endif()
  endforeach()
  list(LENGTH sources count)
  math(EXPR groups "(${count} + ${size} - 1) / ${size}")
  set(united)
  set(first 0)
  while(first LESS count)
    list(LENGTH united group)
    math(EXPR group "${group} + 1")
    math(EXPR end "${count} * ${group} / ${groups}")
    math(EXPR length "${end} - ${first}")
    list(SUBLIST sources ${first} ${length} members)
    set(first ${end})
    if(length EQUAL 1)
      list(APPEND united ${members})
      continue()
    endif()
    set(text "// Written by cmake/Unite.cmake.\n")
    foreach(member IN LISTS members)
      file(RELATIVE_PATH path ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR}/${member})
      string(APPEND text "#include \"${path}\"\n")
    endforeach()
    set(file ${TANKTREAD_UNITED_FOLDER}/${name}_${group}.cpp)
    # What one source has in a namespace is not meant by the next one: only among variables of functions does a name shadow.
    set_source_files_properties(${file} PROPERTIES COMPILE_OPTIONS "-Wno-shadow;-Wshadow=local")
    list(APPEND united ${file})
    file(CONFIGURE OUTPUT ${file} CONTENT "${text}" @ONLY)
  endwhile()
  set(${result} ${united} ${alone} PARENT_SCOPE)
endfunction()

# tanktread_round_each_operation(SOURCES ...): a product and a sum are never fused in these. Where they are depends on what is
# inlined, and that on the other sources of a group; so what is grouped and computes numbers of a run has the same bits in any
# group and by itself. The loops of coupler/ and membrane/ that take the time of a step are not grouped, and may fuse.
function(tanktread_round_each_operation)
  set_property(SOURCE ${ARGN} APPEND PROPERTY COMPILE_OPTIONS -ffp-contract=off)
endfunction()
