// The table of best_fit.glsl at binding 2, where TABLE is defined. To be included before unitvec.glsl.

#ifdef TABLE
layout(set = 0, binding = 2) readonly buffer Table { uint table_words[]; };
#define UNITVEC_BEST_FIT_TABLE(i) table_words[i]
#endif
