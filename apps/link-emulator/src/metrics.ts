import type { Direction, UdpLink } from '@farpoint/link-emulator';
import { dropReasons, type LinkBin } from '@farpoint/network-sim';
import { Counter, Gauge, type Registry } from '@farpoint/service';

/** Registers totals of the bins. `link` may be called only once the program is running. */
export function registerLinkMetrics(registry: Registry, link: () => UdpLink) {
  const registers = [registry];
  const counter = <Name extends string>(name: string, help: string, labelNames: Name[]) =>
    new Counter({ name: `farpoint_link_${name}`, help, labelNames, registers });
  const offered = counter('offered_bytes_total', 'Bytes on the wire that peers sent', ['direction']);
  const delivered = counter('delivered_bytes_total', 'Bytes on the wire that left the bottleneck', [
    'direction',
  ]);
  const drops = counter('dropped_packets_total', 'Packets of peers that were dropped', [
    'direction',
    'reason',
  ]);
  const faults = counter('candidates_left_out_total', 'Candidates that cannot be routed through the link', [
    'fault',
  ]);
  const queue = new Gauge({
    name: 'farpoint_link_queue_ms',
    help: 'Longest time a packet spent at the bottleneck, latest 100 ms',
    labelNames: ['direction'],
    registers,
  });
  new Gauge({
    name: 'farpoint_link_stand_ins',
    help: 'Sockets that stand in for endpoints of peers',
    registers,
    collect() {
      this.set(link().ports);
    },
  });
  return {
    add(direction: Direction, bin: LinkBin): void {
      offered.inc({ direction }, bin.offeredBytes);
      delivered.inc({ direction }, bin.deliveredBytes);
      for (const reason of dropReasons) {
        if (bin.drops[reason] > 0) drops.inc({ direction, reason }, bin.drops[reason]);
      }
      queue.set({ direction }, bin.queueMsMax);
    },
    fault(fault: string): void {
      faults.inc({ fault });
    },
  };
}
