/** Tints in all clouds what the robot would hit and where its floor is missing, by what the robot says of itself. */
import type { Hazards } from '@farpoint/cloud-view';
import type { RobotClient } from '@farpoint/operator';
import { OWN_BODY_M } from '@farpoint/protocol';
import { effect } from '@preact/signals-core';
import { innerRadius } from '../../ground/near-field/around-footprint.ts';
import type { CloudAppearance } from '../../state/cloud-appearance.ts';
import type { SensorClouds } from './sensor-clouds.ts';

export interface HazardParts {
  readonly client: Pick<RobotClient, 'on' | 'link'>;
  readonly clouds: Pick<SensorClouds, 'all'>;
  readonly appearance: Pick<CloudAppearance, 'hazards'>;
}

/** Follows the robot's pose, and what the operator has chosen. */
export function showHazards({ client, clouds, appearance }: HazardParts): void {
  const refresh = () => {
    const hazards = appearance.hazards.peek() ? hazardsOf(client.link.session) : null;
    for (const { colouring } of clouds.all.peek()) colouring.hazards = hazards;
  };
  for (const type of ['telemetry', 'welcome', 'session', 'phase'] as const) client.on(type, refresh);
  effect(() => {
    void [appearance.hazards.value, clouds.all.value];
    refresh();
  });
}

/** `null`: the robot does not say where it is, or which heights matter to it. */
export function hazardsOf({
  welcome,
  telemetry,
}: Pick<RobotClient['link']['session'], 'welcome' | 'telemetry'>): Hazards | null {
  const body = welcome?.body;
  if (body?.heights === undefined || telemetry === null) return null;
  const { position, orientation } = telemetry.pose;
  const ownM = Math.max(innerRadius(body.footprint) - OWN_BODY_M, 0);
  return { ...body.heights, position, orientation, ownM };
}
