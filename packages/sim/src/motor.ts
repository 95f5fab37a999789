/** The room’s air. */
const AMBIENT_CELSIUS = 22;
/** Heat capacity of the windings, J/K, and how well they give heat to the air, W/K. Time constant: 200 s. */
const HEAT_CAPACITY = 120;
const COOLING = 0.6;
/** At rest the motor controller holds the wheel. */
const STANDING_WATTS = 0.4;
/** Share of the robot that a wheel carries: mass, kg, and rolling resistance, N. */
const MASS_KG = 16;
const ROLLING_NEWTONS = 4.5;
/** Losses in the windings for a force at the wheel's rim, W/N². */
const LOSS = 0.12;

/** The temperature of a wheel's motor: copper losses grow with the square of its force, and the air cools it. */
export class Motor {
  #celsius = AMBIENT_CELSIUS;

  /** Lets `dt` seconds pass. @param speed of the rim, m/s @param acceleration of the robot, m/s² */
  step(dt: number, speed: number, acceleration: number): void {
    const rolling = speed === 0 ? 0 : ROLLING_NEWTONS;
    const force = rolling + MASS_KG * Math.abs(acceleration);
    const watts = STANDING_WATTS + LOSS * force * force;
    this.#celsius += ((watts - COOLING * (this.#celsius - AMBIENT_CELSIUS)) * dt) / HEAT_CAPACITY;
  }

  /** °C. */
  get celsius(): number {
    return this.#celsius;
  }
}
