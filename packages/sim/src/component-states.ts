/** What the simulated robot's components report about themselves, as nodes do on /diagnostics. */
import { EMPTY_CHARGE, LOW_CHARGE } from '@farpoint/protocol';
import type { BaseState } from './simulated-base.ts';

/** As in diagnostic_msgs/DiagnosticStatus. */
export interface ComponentState {
  /** 0 for OK, 1 for a warning, 2 for an error. */
  level: 0 | 1 | 2;
  name: string;
  message: string;
}

/** A motor is warm, and hot, above these. Chosen: hard driving warms it within minutes (motor.ts). */
const WARM_CELSIUS = 55;
const HOT_CELSIUS = 75;

export function componentStates({ battery, collision, motorCelsius }: BaseState): ComponentState[] {
  return [
    batteryState(battery),
    motorState('Left motor', motorCelsius.left),
    motorState('Right motor', motorCelsius.right),
    collision
      ? { level: 1, name: 'Bumper', message: 'in contact' }
      : { level: 0, name: 'Bumper', message: 'clear' },
  ];
}

function batteryState({ percentage, voltage, charging }: BaseState['battery']): ComponentState {
  const message = `${Math.round(percentage * 100)} %, ${voltage.toFixed(1)} V${charging ? ', charging' : ''}`;
  const level = percentage < EMPTY_CHARGE ? 2 : percentage < LOW_CHARGE ? 1 : 0;
  return { level, name: 'Battery', message };
}

function motorState(name: string, celsius: number): ComponentState {
  const level = celsius > HOT_CELSIUS ? 2 : celsius > WARM_CELSIUS ? 1 : 0;
  return { level, name, message: `${Math.round(celsius)} °C` };
}
