/** State of charge as in sensor_msgs/BatteryState. */
export interface BatteryState {
  /** Terminal voltage under the present load, V. */
  voltage: number;
  /** Charge, 0 to 1. */
  percentage: number;
  charging: boolean;
}

// Chosen: a base of 32 kg with a pack of 10 Ah, which drives for some hours.
const CAPACITY_WATT_HOURS = 240;
const EMPTY_VOLTS = 21.6;
const FULL_VOLTS = 25.4;
const INTERNAL_OHMS = 0.06;
/** Computer, sensors and radio. */
const IDLE_WATTS = 22;
const CHARGER_WATTS = 180;
const MASS_KG = 32;
const ROLLING_NEWTONS = 9;
const TURNING_NEWTON_METRES = 5;
const DRIVE_EFFICIENCY = 0.65;

/** A pack of eight lithium iron phosphate cells: the voltage falls slightly with charge and current. */
export class Battery {
  #percentage: number;
  #watts = IDLE_WATTS;
  #charging = false;

  constructor(percentage = 0.95) {
    this.#percentage = percentage;
  }

  /** Draws the energy for `dt` seconds of this motion, or charges. Speeds in m/s and rad/s, acceleration in m/s². */
  step(dt: number, linear: number, angular: number, acceleration: number, docked: boolean): void {
    const rolling = ROLLING_NEWTONS * Math.abs(linear) + TURNING_NEWTON_METRES * Math.abs(angular);
    const accelerating = Math.max(0, MASS_KG * acceleration * linear);
    this.#watts = IDLE_WATTS + (rolling + accelerating) / DRIVE_EFFICIENCY - (docked ? CHARGER_WATTS : 0);
    this.#charging = docked && this.#percentage < 1;
    const used = (this.#watts * dt) / (CAPACITY_WATT_HOURS * 3600);
    this.#percentage = Math.min(1, Math.max(0, this.#percentage - used));
  }

  get empty(): boolean {
    return this.#percentage <= 0;
  }

  get state(): BatteryState {
    const open = EMPTY_VOLTS + (FULL_VOLTS - EMPTY_VOLTS) * this.#percentage;
    const voltage = open - (this.#watts / open) * INTERNAL_OHMS;
    return { voltage, percentage: this.#percentage, charging: this.#charging };
  }
}
