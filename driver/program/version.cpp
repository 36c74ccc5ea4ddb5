#include "driver/program/version.hpp"

#include "driver/program/commit.hpp"

namespace tanktread::driver {

const char* const version = TANKTREAD_VERSION;
const char* const commit = TANKTREAD_COMMIT;

}  // namespace tanktread::driver
