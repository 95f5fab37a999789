/** Dependency cycles of a directed graph: its strongly connected components (Tarjan 1972). */

/**
 * The groups of nodes that reach each other, and nodes with an edge to themselves; empty for an acyclic graph. Nodes
 * that appear only as targets count, too. Groups and their nodes are in the order in which the graph names them.
 */
export function cycles<Node>(graph: ReadonlyMap<Node, Iterable<Node>>): Node[][] {
  /** When the search first reached each node. */
  const reached = new Map<Node, number>();
  /** The earliest node on the stack that each node reaches. */
  const lowest = new Map<Node, number>();
  const stack: Node[] = [];
  const onStack = new Set<Node>();
  const groups: Node[][] = [];

  for (const start of graph.keys()) if (!reached.has(start)) visit(start);
  const first = (group: readonly Node[]): number => Math.min(...group.map((node) => reached.get(node) ?? 0));
  return groups
    .map((group) => group.sort((a, b) => (reached.get(a) ?? 0) - (reached.get(b) ?? 0)))
    .sort((a, b) => first(a) - first(b));

  // The search has its own call stack, because a long chain of imports must not exhaust the program's.
  function visit(start: Node): void {
    const calls = [enter(start)];
    for (let call = calls.at(-1); call !== undefined; call = calls.at(-1)) {
      const next = call.edges.next();
      if (next.done === true) {
        calls.pop();
        leave(call.node, calls.at(-1)?.node);
      } else if (!reached.has(next.value)) {
        calls.push(enter(next.value));
      } else if (onStack.has(next.value)) {
        lower(call.node, reached.get(next.value) ?? 0);
      }
    }
  }

  function enter(node: Node): { node: Node; edges: Iterator<Node> } {
    lowest.set(node, reached.size);
    reached.set(node, reached.size);
    stack.push(node);
    onStack.add(node);
    return { node, edges: (graph.get(node) ?? [])[Symbol.iterator]() };
  }

  function leave(node: Node, caller: Node | undefined): void {
    const low = lowest.get(node) ?? 0;
    if (caller !== undefined) lower(caller, low);
    if (low !== reached.get(node)) return;
    const group = stack.splice(stack.lastIndexOf(node));
    for (const member of group) onStack.delete(member);
    if (group.length > 1 || hasEdge(node, node)) groups.push(group);
  }

  function lower(node: Node, to: number): void {
    lowest.set(node, Math.min(lowest.get(node) ?? to, to));
  }

  function hasEdge(from: Node, to: Node): boolean {
    for (const node of graph.get(from) ?? []) if (node === to) return true;
    return false;
  }
}
