# find_package(derive): the function derive_emit of DeriveEmit.cmake, when derive itself is there.

include("${CMAKE_CURRENT_LIST_DIR}/DeriveEmit.cmake")
_derive_find(_derive_missing)
if(_derive_missing)
  set(derive_FOUND FALSE)
  set(derive_NOT_FOUND_MESSAGE "${_derive_missing}")
endif()
unset(_derive_missing)
