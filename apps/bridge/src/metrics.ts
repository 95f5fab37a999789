import { Gauge, type Registry } from 'prom-client';
import type { Bridge } from './bridge.ts';

export function registerBridgeMetrics(registry: Registry, bridge: Bridge): void {
  const gauges: Record<string, [help: string, value: () => number]> = {
    frames_total: ['frames given to pages', () => bridge.frames],
    frames_unsent_total: ['frames a page was too slow for', () => bridge.framesUnsent],
    last_emit_milliseconds: [
      'from the last packet of the latest frame to its message',
      () => bridge.lastEmitMs,
    ],
    robots: ['robots known', () => bridge.roster.size],
    frames_complete: [
      'frames of the robots here that came whole',
      () => bridge.roster.sum((c) => c.assembler.framesComplete),
    ],
    frames_partial: [
      'frames of the robots here that lacked points',
      () => bridge.roster.sum((c) => c.assembler.framesPartial),
    ],
    packets_lost: [
      'packets of the robots here that never came',
      () => bridge.roster.sum((c) => c.packetsLost),
    ],
    packets_recovered: [
      'packets of the robots here that came when asked for',
      () => bridge.roster.sum((c) => c.packetsRecovered),
    ],
    datagrams_refused: [
      'datagrams and packets of the robots here that were dropped unread',
      () => bridge.roster.sum((c) => c.datagramsRefused),
    ],
    robots_failed_total: ['connections to robots that failed', () => bridge.roster.failed],
    robots_refused_total: ['robots there was no room for', () => bridge.roster.refused],
    messages_refused_total: ['messages of pages that could not be read', () => bridge.messagesRefused],
    commands_dropped_total: ['commands for a robot that could not take them', () => bridge.commandsDropped],
  };
  for (const [name, [help, value]] of Object.entries(gauges)) {
    new Gauge({
      name: `farpoint_bridge_${name}`,
      help,
      registers: [registry],
      collect() {
        this.set(value());
      },
    });
  }
}
