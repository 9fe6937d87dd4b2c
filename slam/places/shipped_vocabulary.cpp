#include "slam/places/vocabulary.h"

// The file as bytes of the program: it works wherever it is copied to.
asm(".section .rodata\n"
    ".balign 8\n"
    ".global pas_orb_words_begin\n"
    ".global pas_orb_words_end\n"
    "pas_orb_words_begin:\n"
    ".incbin \"" PAS_ORB_WORDS
    "\"\n"
    "pas_orb_words_end:\n"
    ".byte 0\n"
    ".previous\n");
extern "C" {
extern const char pas_orb_words_begin[];
extern const char pas_orb_words_end[];
}

namespace slam {

const Vocabulary& Vocabulary::Shipped() {
  static const Vocabulary shipped = Parse(
      {pas_orb_words_begin, static_cast<std::size_t>(pas_orb_words_end - pas_orb_words_begin)},
      "the program's vocabulary");
  return shipped;
}

}  // namespace slam
