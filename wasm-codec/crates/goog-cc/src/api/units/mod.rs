mod data_rate;
mod data_size;
mod frequency;
// mod is_newer;
mod time_delta;
mod timestamp;
mod unit_base;

pub use data_rate::*;
pub use data_size::*;
pub use frequency::*;
pub use time_delta::*;
pub use timestamp::*;

//pub(crate) use is_newer::*;
pub(crate) use unit_base::*;
