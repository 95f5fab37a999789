import { PulledMetrics, type Registry } from '@farpoint/service';
import type { Bridge } from './bridge.ts';

export function registerBridgeMetrics(registry: Registry, bridge: Bridge): void {
  const gauges: Record<string, [help: string, value: () => number]> = {
    frames_total: ['frames delivered to pages', () => bridge.frames],
    frames_unsent_total: ['frames not sent because a page was too slow', () => bridge.framesUnsent],
    last_emit_milliseconds: [
      'time from the last packet of the latest frame to its message',
      () => bridge.lastEmitMs,
    ],
    robots: ['robots known', () => bridge.roster.size],
    frames_complete: [
      'complete frames from the robots connected now',
      () => bridge.roster.sum((c) => c.assembler.framesComplete),
    ],
    frames_partial: [
      'incomplete frames from the robots connected now',
      () => bridge.roster.sum((c) => c.assembler.framesPartial),
    ],
    packets_lost: [
      'packets from the robots connected now that never arrived',
      () => bridge.roster.sum((c) => c.packetsLost),
    ],
    packets_recovered: [
      'packets from the robots connected now that arrived after a request',
      () => bridge.roster.sum((c) => c.packetsRecovered),
    ],
    datagrams_refused: [
      'datagrams and packets from the robots connected now that were dropped unread',
      () => bridge.roster.sum((c) => c.datagramsRefused),
    ],
    robots_failed_total: ['connections to robots that failed', () => bridge.roster.failed],
    robots_refused_total: ['robots refused because all places were taken', () => bridge.roster.refused],
    messages_refused_total: ['unreadable messages from pages', () => bridge.messagesRefused],
    commands_dropped_total: ['commands for a robot that could not take them', () => bridge.commandsDropped],
  };
  const metrics = new PulledMetrics(registry, 'farpoint_bridge');
  for (const [name, [help, value]] of Object.entries(gauges)) metrics.gauge(name, help, value);
}
