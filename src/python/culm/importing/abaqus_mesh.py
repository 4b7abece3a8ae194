"""Blocks of Abaqus and CalculiX that make the mesh."""

from . import abaqus_couplings, abaqus_elements, abaqus_nodes, abaqus_sets

BLOCKS = abaqus_nodes.BLOCKS | abaqus_elements.BLOCKS | abaqus_sets.BLOCKS | abaqus_couplings.BLOCKS


def read_mesh_block(reader, block):
    """@return whether the block is one of these"""
    action = BLOCKS.get(block.keyword)
    if action is None:
        return False
    action(reader, block)
    return True
