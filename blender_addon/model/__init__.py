"""What a tan looks like, as numbers: settings, doses, tables, images. No bpy."""
