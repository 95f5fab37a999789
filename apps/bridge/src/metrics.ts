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
    robots: ['robots known', () => bridge.robots],
    robots_failed_total: ['connections to robots that failed', () => bridge.robotsFailed],
    robots_refused_total: ['robots there was no room for', () => bridge.robotsRefused],
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
