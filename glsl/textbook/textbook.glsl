// The functions that people commonly write today, plainly from the formulas: only to measure unitvec against. Not for
// use: docs/textbook.md says what these functions do with vectors that have no direction or no unit length, and which
// of unitvec's replaces each.
//
// Each is named after unitvec's codec, with `textbook_` before its name: `textbook_oct16_encode(v)`. Nothing is
// `precise`, since nobody writes that.

#include "oct.glsl"
#include "hemioct.glsl"
#include "soct.glsl"
#include "spheremap.glsl"
#include "spherical.glsl"
#include "components.glsl"
#include "best_fit.glsl"
#include "parallel.glsl"
#include "frame.glsl"
#include "qtangent.glsl"
