mod interval_budget;
pub use interval_budget::*;
