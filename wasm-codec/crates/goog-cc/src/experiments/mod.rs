mod alr_experiment;
mod field_trials;
mod rate_control;

pub use alr_experiment::*;
pub use field_trials::*;
pub use rate_control::*;
