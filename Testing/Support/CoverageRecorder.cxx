// SPDX-FileCopyrightText: Copyright (c) the Meniscus authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Writes which code a test program has run, for scripts/check_reach.py. Clang's
 * -fsanitize=fuzzer-no-link gives each block of code a counter and a place, and calls the functions
 * below for the program and for each library. If the environment names a folder in
 * MENISCUS_COVERAGE_DIR, the counters are written to it when the program ends.
 */
#include <dlfcn.h>
#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

namespace
{

struct Binary
{
  const std::uint8_t* Begin;
  const std::uint8_t* End;
  /** Address and flags of each block; flag 1 marks the first block of a function. */
  const std::uintptr_t* Places;
};

// Filled before other static objects exist.
std::vector<Binary>& Binaries()
{
  static auto* const binaries = new std::vector<Binary>;
  return *binaries;
}

//------------------------------------------------------------------------------
// PATH.places: the file, then offset and flags of each block. The first process writes it.
void WritePlaces(const Binary& binary, const Dl_info& info, const std::string& path)
{
  std::FILE* file = std::fopen((path + ".places").c_str(), "wx");
  if (!file)
  {
    return;
  }
  std::fprintf(file, "%s\n", info.dli_fname);
  const auto base = reinterpret_cast<std::uintptr_t>(info.dli_fbase);
  for (std::ptrdiff_t i = 0; i < binary.End - binary.Begin; ++i)
  {
    std::fprintf(file, "%zx %zu\n", static_cast<std::size_t>(binary.Places[2 * i] - base),
      static_cast<std::size_t>(binary.Places[2 * i + 1]));
  }
  std::fclose(file);
}

//------------------------------------------------------------------------------
// PATH.PROCESS.counters: a byte for each block.
void WriteCounters()
{
  const char* const folder = std::getenv("MENISCUS_COVERAGE_DIR");
  for (const Binary& binary : Binaries())
  {
    Dl_info info{};
    if (!folder || !binary.Places || dladdr(binary.Places, &info) == 0)
    {
      continue;
    }
    const std::string name = info.dli_fname;
    const std::string path = std::string(folder) + '/' + name.substr(name.rfind('/') + 1);
    WritePlaces(binary, info, path);
    const std::string counters = path + '.' + std::to_string(getpid()) + ".counters";
    if (std::FILE* file = std::fopen(counters.c_str(), "wb"))
    {
      std::fwrite(binary.Begin, 1, static_cast<std::size_t>(binary.End - binary.Begin), file);
      std::fclose(file);
    }
  }
}

} // anonymous namespace

// Libraries call these functions of the program, which hides its others.
#define MENISCUS_VISIBLE __attribute__((visibility("default")))

//------------------------------------------------------------------------------
// Called several times for a binary, each time before the places.
extern "C" MENISCUS_VISIBLE void __sanitizer_cov_8bit_counters_init(
  std::uint8_t* begin, std::uint8_t* end)
{
  std::vector<Binary>& binaries = Binaries();
  if (binaries.empty())
  {
    std::atexit(WriteCounters);
  }
  for (const Binary& binary : binaries)
  {
    if (binary.Begin == begin)
    {
      return;
    }
  }
  binaries.push_back({ begin, end, nullptr });
}

//------------------------------------------------------------------------------
extern "C" MENISCUS_VISIBLE void __sanitizer_cov_pcs_init(
  const std::uintptr_t* begin, const std::uintptr_t*)
{
  Binary& last = Binaries().back();
  last.Places = last.Places ? last.Places : begin;
}
