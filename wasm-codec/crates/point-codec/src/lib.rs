//! Depth-weighted point sampling and the `points64` point layout.
#![forbid(unsafe_code)]
