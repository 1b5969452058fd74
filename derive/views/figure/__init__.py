"""Pictures of bodies: a scene from a record, drawn as SVG and as TikZ."""
