import type { PulledMetrics } from '@farpoint/service';
import type { MeasuredRobot } from './measured-robot.ts';

/** Metrics of the robot's microphone and loudspeaker. None if it has neither. */
export function addSoundMetrics(
  metrics: PulledMetrics,
  { streams: { sound }, operators }: MeasuredRobot,
): void {
  const { microphone, loudspeaker, hasMicrophone } = sound;
  if (hasMicrophone) {
    metrics.gauge('sound_listeners', 'Operators who are sent the microphone’s sound', () => sound.listeners);
    metrics.sum('sound_packets', 'Packets of sound encoded', () => microphone.counters.packets);
    metrics.sum('sound_bytes', 'Bytes of the packets encoded', () => microphone.counters.bytes);
    metrics.gauge(
      'sound_bits_per_second',
      'Rate that the microphone’s encoder is set to; 0 while nobody listens',
      () => microphone.bitsPerSecond,
    );
    metrics.gauge('sound_fault', 'Whether the microphone gives nothing although somebody listens', () =>
      microphone.fault === null ? 0 : 1,
    );
  }
  if (loudspeaker === null) return;
  metrics.gauge('voice_open', 'Whether an operator’s voice is being played', () =>
    sound.speaking === null ? 0 : 1,
  );
  metrics.sums('voice_packets', 'Packets of operators’ voices, by what became of them', 'outcome', () =>
    Object.entries(loudspeaker.counters),
  );
  metrics.sums('voice_packets_dropped', 'Packets of voices that were not played, by reason', 'reason', () =>
    Object.entries(loudspeaker.drops),
  );
  metrics.gauges(
    'voice_packets_refused',
    'Packets from operators connected now that were not taken for a voice, by reason',
    'reason',
    () =>
      [...operators.values()].flatMap(({ sound: { line } }) => Object.entries(line?.voice?.refusals ?? {})),
  );
  metrics.gauge('voice_fault', 'Whether the loudspeaker cannot be used', () =>
    loudspeaker.fault === null ? 0 : 1,
  );
}
