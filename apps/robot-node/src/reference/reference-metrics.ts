import { Gauge, type Registry } from '@farpoint/service';
import type { Robot } from '../robot.ts';

/** Puts the reference profile's counters on `/metrics`, where the robot has it. */
export function registerReferenceMetrics(registry: Registry, robot: Robot): void {
  const { reference } = robot;
  if (reference === null) return;
  const ofStream = (name: 'framesSent' | 'packetsSent' | 'bytesSent') => () =>
    reference.operator?.sender?.counters[name] ?? 0;
  const gauges: Record<string, [help: string, value: () => number]> = {
    registered: ['1 while the reference signaling has this robot', () => Number(reference.registered)],
    offers: ['Offers made since the start', () => reference.offers],
    answers_refused: [
      'Answers that were none to the open offer, since the start',
      () => reference.answersRefused,
    ],
    connected: ['Reference operators that connected since the start', () => reference.connected],
    operators: ['Reference operators now', () => reference.targets.length],
    frames_sent: ['Frames sent to the present reference operator', ofStream('framesSent')],
    packets_sent: ['Packets sent to the present reference operator', ofStream('packetsSent')],
    bytes_sent: ['Bytes on the wire to the present reference operator', ofStream('bytesSent')],
    command_bursts: [
      'Commands of the present reference operator that had stood in a queue and were taken for a stop',
      () => reference.operator?.driver.bursts ?? 0,
    ],
  };
  for (const [name, [help, value]] of Object.entries(gauges)) {
    new Gauge({
      name: `farpoint_robot_reference_${name}`,
      help,
      registers: [registry],
      collect() {
        this.set(value());
      },
    });
  }
}
