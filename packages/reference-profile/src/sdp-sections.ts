/** Splits SDP into its media sections (RFC 8866 §5.14). Text in, lines out; nothing is validated. */
export interface SdpSection {
  /** The `m=` line: media, port, protocol, formats. */
  media: string;
  /** `a=` lines without the prefix. */
  attributes: string[];
}

/** Trailing blanks are ignored, because the released programs write some. */
export function sdpSections(sdp: string): SdpSection[] {
  const sections: SdpSection[] = [];
  for (const line of sdpLines(sdp)) {
    if (line.startsWith('m=')) sections.push({ media: line.slice(2), attributes: [] });
    else if (line.startsWith('a=')) sections.at(-1)?.attributes.push(line.slice(2));
  }
  return sections;
}

export function sdpLines(sdp: string): string[] {
  return sdp.split(/\r?\n/).map((line) => line.trimEnd());
}
