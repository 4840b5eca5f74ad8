// The table of best_fit.glsl at binding 2, where TABLE is defined. Include it before unitvec.glsl.

#ifdef TABLE
layout(set = 0, binding = 2) readonly buffer Table { uint table_words[]; };
#define UNITVEC_BEST_FIT_TABLE(i) table_words[i]
// The words that the codecs look up: with a shorter table the kernels do nothing.
#define HAS_TABLE (table_words.length() >= 206080)
#endif
