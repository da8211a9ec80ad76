# storey_warnings: linked PRIVATE by every target of this project, never exported.
add_library(storey_warnings INTERFACE)
target_compile_options(storey_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Woverloaded-virtual
  -ffp-contract=off  # the same bytes from every compiler and machine
  # GCC 13 takes Eigen's small fixed-size decompositions for uses of uninitialized values.
  "$<$<BOOL:${STOREY_WERROR}>:-Werror;-Wno-error=maybe-uninitialized>")
