import type { BlindTravelLimits, RampLimits, ViewAgeLimits } from '@farpoint/safety';

/** How the robot's motion is bounded, by its configuration only. */
export interface MotionLimits {
  ramps: RampLimits;
  /** What the driver must see; `null`: it may drive without seeing anything. */
  view: (ViewAgeLimits & BlindTravelLimits) | null;
}
