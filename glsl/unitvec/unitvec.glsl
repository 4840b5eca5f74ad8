// unitvec: all codec families. See the family's file for its functions.

#include "scalar.glsl"
#include "math.glsl"
#include "oct.glsl"
#include "hemioct.glsl"
#include "oct_wide.glsl"
#include "spherical.glsl"
#include "cylindrical.glsl"
#include "latlong.glsl"
#include "best_fit.glsl"
#include "azimuthal.glsl"
