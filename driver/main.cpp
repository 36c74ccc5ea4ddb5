#include "driver/program_main.hpp"

int main(int argc, char** argv) {
  return tanktread::driver::program_main(argc, argv);
}
