//! Compressed blocks of 4 by 4 texels.
