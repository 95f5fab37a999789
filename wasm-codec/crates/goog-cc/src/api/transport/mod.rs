mod bandwidth_usage;
mod ecn_marking;
mod network_types;

pub use bandwidth_usage::*;
pub use ecn_marking::*;
pub use network_types::*;
