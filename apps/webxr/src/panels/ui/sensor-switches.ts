/** For a robot with several sensors: one button per sensor that switches its clouds on or off. */
import { effect } from '@preact/signals-core';
import type { Switch, Switches } from '../../ground/switches.ts';
import { texts } from '../../words/language.ts';
import { elements } from './elements.ts';

export function showSensorSwitches(switches: Switches): void {
  const { sensors } = elements;
  effect(() => {
    sensors.hidden = switches.all.value.length === 0;
    sensors.replaceChildren(...switches.all.value.map((sensor) => buttonOf(sensor, switches)));
  });
}

function buttonOf({ index, name, on }: Switch, switches: Switches): HTMLButtonElement {
  const button = document.createElement('button');
  button.type = 'button';
  button.className = 'quiet';
  button.textContent = name;
  button.ariaPressed = String(on.value);
  const { sensorOn, sensorOff } = texts().clouds;
  button.title = (on.value ? sensorOn : sensorOff)(name);
  button.addEventListener('click', () => {
    // A button that kept the focus would take the space bar, which is the drive grip.
    button.blur();
    switches.toggle(index);
  });
  return button;
}
