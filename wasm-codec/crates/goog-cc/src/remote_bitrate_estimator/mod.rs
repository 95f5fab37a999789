mod aimd_rate_control;
mod bwe_defines;
// unused?
//mod inter_arrival;

pub use aimd_rate_control::*;
pub use bwe_defines::*;
