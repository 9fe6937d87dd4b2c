# pas_check_headers(slam sim): the target `headers` compiles each header of these folders by itself,
# without the precompiled ones, so that none leans on what another file included before it.
function(pas_check_headers)
  set(sources)
  foreach(folder ${ARGN})
    file(GLOB_RECURSE headers CONFIGURE_DEPENDS RELATIVE ${PROJECT_SOURCE_DIR}
         ${PROJECT_SOURCE_DIR}/${folder}/*.h)
    foreach(header ${headers})
      set(source ${PROJECT_BINARY_DIR}/headers/${header}.cpp)
      file(CONFIGURE OUTPUT ${source} CONTENT "#include \"${header}\"\n")
      list(APPEND sources ${source})
    endforeach()
  endforeach()
  add_library(headers OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(headers PRIVATE pas_settings sim_all slam_all eval_all app_all)
  target_compile_options(headers PRIVATE -Wno-psabi)  # as pas_lanes
endfunction()
