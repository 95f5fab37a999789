/** A button for each sensor of a robot that has several: its clouds on or off. */
import type { SensorClouds } from '../view/sensor-clouds.ts';
import { elements } from './elements.ts';

export function showSensors(clouds: SensorClouds): void {
  const { sensors } = elements;
  sensors.hidden = clouds.sensors.length === 0;
  sensors.replaceChildren(
    ...clouds.sensors.map((cloud) => {
      const button = document.createElement('button');
      button.type = 'button';
      button.className = 'quiet';
      button.textContent = cloud.name;
      button.ariaPressed = String(cloud.wanted);
      button.title = `${cloud.name}: clouds ${cloud.wanted ? 'on' : 'off'}`;
      button.addEventListener('click', () => {
        // A button that keeps the focus would take the space bar.
        button.blur();
        clouds.toggle(cloud);
      });
      return button;
    }),
  );
}
