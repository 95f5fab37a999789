import type { RosGraph } from '@farpoint/ros';

/** Tells each fault of a graph once: a fault that repeats itself, unless another came between, says nothing new. */
export function tellNewFaults(graph: Pick<RosGraph, 'onFault'>, tell: (detail: string) => void): void {
  let last = '';
  graph.onFault = ({ message }) => {
    if (message !== last) tell(message);
    last = message;
  };
}
