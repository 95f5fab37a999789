/** What an attack has sent, and what it has measured. */
export class Tally {
  readonly packets: number;
  readonly text: string;

  constructor(packets: number, text: string) {
    this.packets = packets;
    this.text = text;
  }
}
